// Scores and ranks edges (paper section 4, eqs. 14-18, Algorithm 6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/corners.hpp"
#include "thermedge/stages/linking.hpp"

namespace thermedge {

struct ScoringOptions {
  double loop_line_ratio = 2.0;  // Phi of a loop (a line has 1), > 0 (the text names no value)

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<ScoringOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("loop_line_ratio", o.loop_line_ratio, Bounds{1e-6, 1e6}, "Phi of a loop (a line has 1)");
}

// Of the score by saliency. Chosen on the simulated scenes of docs/experiments.md.
struct ScoringTuning {
  double least_mean = 0.02;  // least mean suppressed response, in units of the noise, so that the
                             // logarithm is finite; far below the low threshold of the edge pixels
  double length_weight = 0.25;  // of log N against log of the mean response: a larger one prefers
                                // long edges to strong ones, and noise makes no long edges
  // Scores between which display_strength rises from 0 to 1: hardly there, and a wall at a hundred
  // times the noise. For pictures only.
  double faintest_score = -1.5;
  double strongest_score = 4.5;
};

// Residual sum of squares of the least-squares cubic y = a x^3 + b x^2 + c x + d through points
// (eqs. 14-15), px^2; of the minimum-norm solution where fewer than four abscissae differ. What is
// below 1e-9, no more than rounding, is 0. No points: 0.
[[nodiscard]] double cubic_residual(std::span<const Pixel> points);

// What eq. 18 is made of.
struct EdgeScoreTerms {
  double average_residual = 0;   // AR = sum of RSS / N (eq. 16), px^2
  double width = 0, height = 0;  // W, L: of the frame, px
  double points = 0;             // N
  double corners = 0;            // M, the two ends counted
  double connected_points = 0;   // N': N and the points of the distinct edges directly connected
  double loop_line_ratio = 1;    // Phi
};

// ES = AR W L M^2 / (N^2 N' Phi) (eq. 18): smaller is smoother, longer, better connected.
[[nodiscard]] double edge_score(const EdgeScoreTerms& terms);

// log(mean suppressed_response) + length_weight log N of a curve, the mean over the pixels that
// have one (above 0).
[[nodiscard]] double saliency(std::span<const Pixel> pixels,
                              ImageView<const float> suppressed_response,
                              const ScoringTuning& tuning = {});

// Scores and ranks: fills `edges` from linked contours and their corners, best first. Ties: the
// edge with more points, then the earlier contour. The id of an edge is its rank. Everything but
// the measured fields (normals, magnitude, contrast, z, NFA) and what is kept
// (selection.hpp) is set.
// The score is -ES, or, given the suppressed_response of edge pixels in units of the noise,
// log(mean suppressed_response) + length_weight log N: larger is better then. Contrast counts more
// than length, and smoothness not at all: ES prefers edges along the axis of the abscissae, and
// short ones. Parts to be fitted run from corner to corner; the first and the last point of a
// curve, closed or not, always count as corners here (P1 = C1, PN = CM), so that M >= 2. Paper:
// section 4, Algorithm 6. One object per thread; allocates on the first frame of a size only.
class Scorer {
 public:
  explicit Scorer(const ScoringOptions& options, const ScoringTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // `width`, `height`: of the frame; `corners`: of `linked.contours`. `edges` is cleared first.
  // Errors: an option out of range.
  [[nodiscard]] Status run(const LinkedContours& linked, const CornerSet& corners, int width,
                           int height, EdgeSet& edges);
  [[nodiscard]] Status run(const LinkedContours& linked, const CornerSet& corners,
                           ImageView<const float> suppressed_response, EdgeSet& edges);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(connections_, order_, rank_of_);
  }

 private:
  struct Ranked {
    double score;  // larger is better
    double es;
    std::uint32_t points;
    std::uint32_t contour;
  };
  struct Connection {  // contours while scoring, ranks afterwards
    std::uint32_t from;
    std::uint32_t to;
    friend bool operator==(const Connection&, const Connection&) = default;
    friend bool operator<(const Connection& a, const Connection& b) {
      return a.from != b.from ? a.from < b.from : a.to < b.to;
    }
  };

  void prepare(const LinkedContours& linked, const CornerSet& corners, EdgeSet& edges);
  void collect_connections(const LinkedContours& linked);
  [[nodiscard]] Status score_contours(const LinkedContours& linked, const CornerSet& corners,
                                      double frame_width, double frame_height, EdgeSet& edges);
  void score_by_saliency(const ContourSet& contours, ImageView<const float> suppressed_response);
  void fill(const LinkedContours& linked, const CornerSet& corners, EdgeSet& edges);
  void rank_contours();
  void append_edge(const LinkedContours& linked, const CornerSet& corners, std::size_t rank,
                   EdgeSet& edges) const;
  void set_connections(EdgeSet& edges);

  ScoringOptions options_;
  ScoringTuning tuning_;
  std::vector<Connection> connections_;  // both directions, ascending, distinct
  std::vector<Ranked> order_;            // best first
  std::vector<std::uint32_t> rank_of_;   // of each contour
};

}  // namespace thermedge
