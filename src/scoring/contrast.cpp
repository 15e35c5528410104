#include "thermedge/stages/contrast.hpp"

#include <algorithm>
#include <cmath>

#include "edgel_contrast.hpp"

namespace thermedge {
namespace {

double number_of_tests(const EdgeSet& edges) {
  double tests = 0;
  for (const Edge& edge : edges.edges) {
    const double points = edge.edgels.count;
    tests += points * (points - 1) / 2;
  }
  return std::max(tests, 1.0);
}

}  // namespace

void measure_contrast(ImageView<const std::uint16_t> frame, double sigma_counts, EdgeSet& edges,
                      const ContrastTuning& tuning) {
  const double log10_tests = std::log10(number_of_tests(edges));
  for (Edge& edge : edges.edges) {
    detail::set_normals(edges.edgels, edge);
    detail::Contrast contrast = detail::contrast_across(frame, edges.edgels, edge.edgels, tuning);
    detail::take_contrast(frame, sigma_counts, edges.edgels, edge, contrast);
    edge.z = detail::z_of(contrast, sigma_counts);
    edge.contrast_sigmas = detail::in_sigmas(edge.contrast_counts, sigma_counts);
    edge.log10_nfa = log10_tests + std::log10(2.0) + detail::log10_tail(edge.z);
  }
}

void set_normals_from_shape(EdgeSet& edges) {
  for (const Edge& edge : edges.edges) {
    detail::set_normals(edges.edgels, edge);
  }
}

}  // namespace thermedge
