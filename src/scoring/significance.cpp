#include "thermedge/stages/significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "contrast_spread.hpp"
#include "edgel_contrast.hpp"
#include "hysteresis.hpp"
#include "order_statistics.hpp"
#include "sort_simd.hpp"
#include "suppression_simd.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/stages/scoring.hpp"

namespace thermedge {
namespace {

struct Vector {
  double x = 0;
  double y = 0;
};

// Unit vectors at all directions of edges.
std::array<Vector, kEdgeDirections> directions() {
  std::array<Vector, kEdgeDirections> along;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double angle = static_cast<double>(i) * std::numbers::pi / kEdgeOrientations;
    along[i] = {std::cos(angle), std::sin(angle)};
  }
  return along;
}

// What slopes make of a contrast, measured on one side of an edge.
struct SideSlopes {
  double chord = 0;
  double ramp = 0;            // by its less steep half
  bool are_measured = false;  // there is room for a chord beside most of the edge
};

// Mean of the values but for a share at either end of their order; 0 of none. Reorders them.
double trimmed_mean(std::vector<double>& values, double share) {
  if (values.empty()) {
    return 0;
  }
  const auto cut = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto begin = values.begin() + cut;
  const auto end = values.end() - cut;
  if (values.size() <= detail::kFewValues) {
    detail::sort_few(values);
  } else {  // what is left out needs no order
    std::nth_element(values.begin(), begin, values.end());
    std::nth_element(begin, end, values.end());
    detail::sort_values({begin, end});
  }
  // In their order, so that it makes no difference from which end the edge is walked.
  return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

// Root mean square of the map's levels along an edge.
double level_along(const NoiseLevelMap& map, const Edgels& edgels, Range range) {
  double squares = 0;
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    const double level = map.at(static_cast<int>(edgels.x[i]), static_cast<int>(edgels.y[i]));
    squares += level * level;
  }
  return std::sqrt(squares / range.count);
}

// Of an edge, counts.
struct Step {
  double counts = 0;  // contrast less the slope
  double slope = 0;   // what slopes of the scene make of the contrast
};

// For an edge and against noise.
struct Evidence {
  double climb = 0;          // how far it stands out of edges of noise, in their deviations
  double log_response = 0;   // natural logarithm of its mean suppressed response
  double excess_length = 0;  // edgels beyond the shortest edges
};

}  // namespace

struct SignificanceTest::Impl {
  explicit Impl(const SignificanceTuning& chosen)
      : tuning(chosen), spread(chosen.spread, chosen.slopes, chosen.contrast) {}

  void prepare(int width, int height, const EdgeSet& edges);
  void find_strongest(const OrientedFilterResult& pixels, ImageView<const std::uint8_t> valid);
  float response_of_scene();
  void mark_busy(const OrientedFilterResult& pixels, ImageView<const std::uint8_t> valid);
  void orient(const OrientedFilterResult& pixels, const Edge& edge, Edgels& edgels) const;
  detail::Contrast contrast_of(ImageView<const std::uint16_t> frame, const Edgels& edgels,
                               Range range, std::vector<double>& of_edgels) const;
  SideSlopes slopes(ImageView<const std::uint16_t> frame, const Edgels& edgels, Range range,
                    double side, std::vector<double>& of_edgels) const;
  double explained(ImageView<const std::uint16_t> frame, const Edgels& edgels, Range range,
                   double level, double contrast, std::vector<double>& of_edgels) const;
  void test_edge(ImageView<const std::uint16_t> frame, const NoiseModel& noise,
                 const OrientedFilterResult& pixels, std::vector<double>& of_edgels, Edgels& edgels,
                 Edge& edge) const;
  [[nodiscard]] double z_of_edge(const NoiseModel& noise, const Edgels& edgels, const Edge& edge,
                                 const Step& step) const;
  [[nodiscard]] Evidence evidence_for(const Edge& edge) const;
  void count_false_alarms(double pixels, EdgeSet& edges);

  SignificanceTuning tuning;
  detail::ContrastSpread spread;
  std::vector<float> of_scene;    // responses of a row, with a margin of clearance_px
  Image<float> strongest_in_row;  // with clearance_px rows of zeros above and below
  Image<float> strongest;
  std::vector<float> responses;
  Image<std::uint8_t> busy;
  // Each task takes every so many-th edge; their values for the edgels of one edge.
  std::array<std::vector<double>, 4> scratch;
  std::vector<Evidence> evidence;  // for each edge
  std::array<Vector, kEdgeDirections> along = directions();
};

void SignificanceTest::Impl::prepare(int width, int height, const EdgeSet& edges) {
  spread.prepare(width, height);
  const int reach = tuning.spread.clearance_px;
  constexpr int kVector = Image<float>::kAlignmentBytes / int{sizeof(float)};
  of_scene.resize(static_cast<std::size_t>(width + 2 * reach + kVector));
  strongest_in_row.resize(width, height + 2 * reach);
  for (int i = 0; i < reach; ++i) {
    std::fill_n(strongest_in_row.row(i), width, 0.0F);
    std::fill_n(strongest_in_row.row(height + 2 * reach - 1 - i), width, 0.0F);
  }
  strongest.resize(width, height);
  responses.reserve(strongest.size());
  busy.resize(width, height);
  for (std::vector<double>& values : scratch) {
    values.reserve(edges.edgels.x.capacity());
  }
  evidence.reserve(edges.edges.capacity());
}

// The largest response of an edge pixel of the scene near each pixel, 0 where none is near;
// infinite near what is no measurement.
void SignificanceTest::Impl::find_strongest(const OrientedFilterResult& pixels,
                                            ImageView<const std::uint8_t> valid) {
  const int width = pixels.edges.width();
  const int height = pixels.edges.height();
  const int reach = tuning.spread.clearance_px;
  const int taps = 2 * reach + 1;
  const auto sure = static_cast<float>(tuning.spread.sure_response);
  for (int y = 0; y < height; ++y) {
    float* row = of_scene.data() + reach;
    std::fill(of_scene.begin(), of_scene.end(), 0.0F);
    const std::uint8_t* const edges = pixels.edges.row(y);
    const std::uint8_t* const end = edges + width;
    const std::uint8_t* at = edges;
    while ((at = detail::find_pixel(at, end, detail::kKeptEdge)) != end) {
      const float response = pixels.suppressed_response(static_cast<int>(at - edges), y);
      row[at++ - edges] = response > sure ? response : 0;
    }
    if (!valid.empty()) {
      std::transform(row, row + width, valid.row(y), row,
                     [](float response, std::uint8_t is_valid) {
                       return is_valid != 0 ? response : std::numeric_limits<float>::infinity();
                     });
    }
    detail::largest_row(of_scene.data(), 1, taps, width, strongest_in_row.row(y + reach));
  }
  for (int y = 0; y < height; ++y) {
    detail::largest_row(strongest_in_row.row(y), strongest_in_row.stride(), taps, width,
                        strongest.row(y));
  }
}

// What the response of an edge of the scene exceeds. More than usual where such responses are all
// over the frame: they are a pattern of the sensor then, or a texture.
float SignificanceTest::Impl::response_of_scene() {
  responses.clear();  // those near edges
  std::size_t free = 0;
  for (int y = 0; y < strongest.height(); ++y) {
    const float* const row = strongest.row(y);
    std::copy_if(row, row + strongest.width(), std::back_inserter(responses),
                 [](float response) { return response > 0 && std::isfinite(response); });
    free += static_cast<std::size_t>(std::count(row, row + strongest.width(), 0.0F));
  }
  const auto rank = static_cast<std::size_t>(tuning.spread.least_measured *
                                             static_cast<double>(free + responses.size()));
  return free > rank || responses.empty() ? static_cast<float>(tuning.spread.sure_response)
                                          : detail::nth_value(std::span(responses), rank - free);
}

void SignificanceTest::Impl::mark_busy(const OrientedFilterResult& pixels,
                                       ImageView<const std::uint8_t> valid) {
  find_strongest(pixels, valid);
  const float least = response_of_scene();
  for (int y = 0; y < busy.height(); ++y) {
    std::transform(strongest.row(y), strongest.row(y) + busy.width(), busy.row(y),
                   [=](float response) { return response > least ? 1 : 0; });
  }
}

// Normals to the side that is warmer by the filter.
void SignificanceTest::Impl::orient(const OrientedFilterResult& pixels, const Edge& edge,
                                    Edgels& edgels) const {
  for (std::size_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
    const int steps =
        pixels.direction(static_cast<int>(edgels.x[i]), static_cast<int>(edgels.y[i]));
    const Vector way = along[static_cast<std::size_t>(steps)];
    if (way.x * edgels.ny[i] - way.y * edgels.nx[i] < 0) {
      detail::flip_normals(edgels, {static_cast<std::uint32_t>(i), 1});
    }
  }
}

// Where an edge begins or ends at another one, the contrast is that of the other one.
detail::Contrast SignificanceTest::Impl::contrast_of(ImageView<const std::uint16_t> frame,
                                                     const Edgels& edgels, Range range,
                                                     std::vector<double>& of_edgels) const {
  of_edgels.clear();
  // In whole steps, so that it makes no difference from which end the edge is walked.
  constexpr double kSteps = 1 << 16;
  std::int64_t blurred_steps = 0;
  detail::Contrast found;
  detail::for_each_run(range, [&](std::size_t first, std::size_t count) {
    detail::RunOfContrasts part;
    detail::contrasts_across(frame, edgels, first, count, tuning.contrast, part);
    for (std::size_t i = 0; i < count; ++i) {
      found.samples += part.samples[i];
      if (part.samples[i] > 0) {
        of_edgels.push_back(part.mean(i));
        blurred_steps += std::llround(kSteps * (part.mean_beyond_flank(i) - part.mean(i)));
      }
    }
  });
  const auto edgels_seen = static_cast<double>(std::max<std::size_t>(of_edgels.size(), 1));
  found.counts = trimmed_mean(of_edgels, tuning.contrast_trim);
  found.beyond_flank = found.counts + static_cast<double>(blurred_steps) / kSteps / edgels_seen;
  return found;
}

SideSlopes SignificanceTest::Impl::slopes(ImageView<const std::uint16_t> frame,
                                          const Edgels& edgels, Range range, double side,
                                          std::vector<double>& of_edgels) const {
  const SideSlopeTuning& own = tuning.slopes;
  const auto mean_over = [&](double from_px, double to_px) {
    of_edgels.clear();
    detail::for_each_run(range, [&](std::size_t first, std::size_t count) {
      detail::RunOfDoubles part;
      detail::slopes_beside(frame, edgels, first, count, {side, from_px, to_px}, part);
      std::copy_if(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count),
                   std::back_inserter(of_edgels), [](double slope) { return !std::isnan(slope); });
    });
    return trimmed_mean(of_edgels, own.trim);
  };
  SideSlopes found;
  found.chord = mean_over(own.chord_from_px, own.chord_to_px);
  found.are_measured = 2 * of_edgels.size() > range.count;
  found.ramp = std::min(mean_over(own.ramp_from_px, own.ramp_by_px),
                        mean_over(own.ramp_by_px, own.ramp_to_px));
  return found;
}

// The part of a contrast that slopes of the scene explain, counts.
double SignificanceTest::Impl::explained(ImageView<const std::uint16_t> frame, const Edgels& edgels,
                                         Range range, double level, double contrast,
                                         std::vector<double>& of_edgels) const {
  const SideSlopeTuning& own = tuning.slopes;
  SideSlopes ahead = slopes(frame, edgels, range, 1, of_edgels);
  SideSlopes behind = slopes(frame, edgels, range, -1, of_edgels);
  // Beside the border of the frame the slope is taken to go on as it does on the other side.
  if (!ahead.are_measured) {
    ahead = behind;
  }
  if (!behind.are_measured) {
    behind = ahead;
  }
  const double through = std::min((ahead.chord + behind.chord) / 2,
                                  own.most_uneven * std::min(ahead.chord, behind.chord));
  // Of two pixels, that far apart, for every edgel.
  const double deviation = detail::kContrastPx / (own.ramp_by_px - own.ramp_from_px) * level *
                           std::sqrt(2.0 / range.count);
  const double ramp = std::min(std::max(ahead.ramp, behind.ramp) - own.ramp_sigmas * deviation,
                               own.most_of_ramp * contrast);
  return std::max({through, ramp, 0.0});
}

double SignificanceTest::Impl::z_of_edge(const NoiseModel& noise, const Edgels& edgels,
                                         const Edge& edge, const Step& step) const {
  const double variance = spread.variance(edgels, edge.edgels, noise.map);
  // The slope's own noise counts as far as there is one.
  const double of_slope = tuning.spread.slope_share;
  const double share =
      std::min(step.slope / (noise.level_counts * std::sqrt(variance * of_slope)), 1.0);
  return step.counts /
         (noise.level_counts * std::sqrt(variance * (1 - of_slope + share * of_slope)));
}

void SignificanceTest::Impl::test_edge(ImageView<const std::uint16_t> frame,
                                       const NoiseModel& noise, const OrientedFilterResult& pixels,
                                       std::vector<double>& of_edgels, Edgels& edgels,
                                       Edge& edge) const {
  detail::set_normals(edgels, edge);
  orient(pixels, edge, edgels);
  detail::Contrast contrast = contrast_of(frame, edgels, edge.edgels, of_edgels);
  detail::take_contrast(frame, noise.level_counts, edgels, edge, contrast);
  edge.contrast_sigmas = detail::in_sigmas(
      edge.contrast_counts, noise.level_counts * level_along(noise.map, edgels, edge.edgels));
  const double slope =
      explained(frame, edgels, edge.edgels, noise.level_counts, contrast.counts, of_edgels);
  contrast.counts = std::max(contrast.counts - slope, 0.0);
  if (noise.level_counts > 0) {
    edge.z = z_of_edge(noise, edgels, edge, {contrast.counts, slope});
  } else {
    edge.z = detail::z_of(contrast, 0);
    edge.log10_nfa = detail::log10_tail(edge.z);
  }
}

Evidence SignificanceTest::Impl::evidence_for(const Edge& edge) const {
  const NoiseEdgeTuning& own = tuning.noise_edges;
  const double edgels = edge.edgels.count;
  const double of_ring = edge.closed ? std::min(own.ring_climb, own.ring_climb_edgels / edgels) : 0;
  return {(edge.z - own.climb * std::sqrt(edgels) - of_ring) / own.deviation,
          edge.score - ScoringTuning().length_weight * std::log(edgels),
          std::max(edgels - own.shortest, 0.0)};
}

void SignificanceTest::Impl::count_false_alarms(double pixels, EdgeSet& edges) {
  const NoiseEdgeTuning& own = tuning.noise_edges;
  evidence.clear();
  std::transform(edges.edges.begin(), edges.edges.end(), std::back_inserter(evidence),
                 [&](const Edge& edge) { return evidence_for(edge); });
  // Those below the mean of noise stand for as many above it.
  const auto for_each_candidate = [&](auto&& task) {
    for (std::size_t i = 0; i < evidence.size(); ++i) {
      if (edges.edges[i].z > 0 && evidence[i].climb < 0) {
        task(evidence[i]);
      }
    }
  };
  double candidates = 0;
  double length = own.weight * own.mean_length;
  double log_response = own.weight * own.log_response;
  for_each_candidate([&](const Evidence& found) {
    candidates += 2;
    length += 2 * found.excess_length;
    log_response += 2 * found.log_response;
  });
  const double weight = candidates + own.weight;
  length = std::clamp(length / weight, own.mean_length, own.longest_mean_length);
  log_response /= weight;
  double excess = own.weight * own.log_response_excess;
  for_each_candidate([&](const Evidence& found) {
    excess += 2 * std::max(found.log_response - log_response, 0.0);
  });
  excess *= 2 / weight;  // the mean of an exponential one, of which half is above the mean
  const auto sure = std::count_if(evidence.begin(), evidence.end(), [&](const Evidence& found) {
    return found.climb > own.sure_deviations;
  });
  candidates = std::max(candidates - own.faint_per_sure * static_cast<double>(sure),
                        pixels / own.px_per_candidate);
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const Evidence& found = evidence[i];
    const double of_climb = -detail::log10_tail(found.climb) / std::numbers::log10e;
    const double of_the_rest =
        found.excess_length / length + std::max(found.log_response - log_response, 0.0) / excess;
    const double x = found.climb >= own.least_climb ? of_climb + of_the_rest : of_climb;
    edges.edges[i].log10_nfa =
        std::log10(candidates * (1 + x + x * x / 2)) - x * std::numbers::log10e;
  }
}

SignificanceTest::SignificanceTest(const SignificanceTuning& tuning)
    : impl_(std::make_unique<Impl>(tuning)) {}
SignificanceTest::SignificanceTest(SignificanceTest&&) noexcept = default;
SignificanceTest& SignificanceTest::operator=(SignificanceTest&&) noexcept = default;
SignificanceTest::~SignificanceTest() = default;

std::size_t SignificanceTest::memory_bytes() const {
  std::size_t sum =
      detail::memory_of(impl_->spread, impl_->of_scene, impl_->strongest_in_row, impl_->strongest,
                        impl_->responses, impl_->busy, impl_->evidence);
  for (const std::vector<double>& values : impl_->scratch) {
    sum += detail::memory_of(values);
  }
  return sum;
}

void SignificanceTest::run(ImageView<const std::uint16_t> frame, const NoiseModel& noise,
                           ImageView<const std::uint8_t> valid, const OrientedFilterResult& pixels,
                           EdgeSet& edges, ParallelRunner& runner) {
  Impl& self = *impl_;
  const bool is_noisy = noise.level_counts > 0;
  self.prepare(frame.width(), frame.height(), edges);
  if (is_noisy) {
    self.mark_busy(pixels, valid);
    self.spread.measure(frame, self.busy, noise, runner);
  }
  const auto tasks = self.scratch.size();
  runner.run(static_cast<int>(tasks), [&](int task) {
    const auto first = static_cast<std::size_t>(task);
    for (std::size_t i = first; i < edges.edges.size(); i += tasks) {
      self.test_edge(frame, noise, pixels, self.scratch[first], edges.edgels, edges.edges[i]);
    }
  });
  if (is_noisy) {
    self.count_false_alarms(static_cast<double>(frame.size()), edges);
  }
}

}  // namespace thermedge
