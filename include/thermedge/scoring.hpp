// Scores and ranks edges (paper section 4, eqs. 14-18, Algorithm 6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/contours.hpp"
#include "thermedge/corners.hpp"
#include "thermedge/edges.hpp"
#include "thermedge/linking.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct ScoringOptions {
  int keep_edges = 60;           // ET: the best so many edges are kept; 0: all
  int max_edgels = 0;            // most edgels in the kept edges together; 0: any number
  double loop_line_ratio = 2.0;  // Phi of a loop (a line has 1), > 0 (the text names no value)
};

// Residual sum of squares of the least-squares cubic y = a x^3 + b x^2 + c x + d through points
// (eqs. 14-15); the minimum-norm solution where fewer than four abscissae differ. x and y are
// centred first, which does not change the residual. No points: 0.
[[nodiscard]] double cubic_residual(std::span<const Pixel> points);

// What eq. 18 is made of.
struct EdgeScoreTerms {
  double average_residual = 0;  // AR = sum of RSS / N (eq. 16), px^2
  double width = 0, height = 0; // W, L: of the frame, px
  double points = 0;            // N
  double corners = 0;           // M, the two ends counted
  double connected_points = 0;  // N': N and the points of the distinct edges directly connected
  double loop_line_ratio = 1;   // Phi
};

// ES = AR W L M^2 / (N^2 N' Phi) (eq. 18): smaller is smoother, longer, better connected.
[[nodiscard]] double edge_score(const EdgeScoreTerms& terms);

// Scores, ranks and keeps: fills `edges` from linked contours and their corners. Everything but the
// measured fields (normals, magnitude, contrast, z, NFA) is set; see measure.hpp for those.
// One object per thread.
class Scorer {
 public:
  explicit Scorer(const ScoringOptions& options) : options_(options) {}

  // `width`, `height`: of the frame. `edges` is cleared first. Errors: an option out of range.
  [[nodiscard]] Status run(const LinkedContours& linked, const CornerSet& corners, int width,
                           int height, EdgeSet& edges);

 private:
  struct Ranked {
    double score;
    std::uint32_t contour;
  };
  ScoringOptions options_;
  std::vector<Ranked> order_;
  std::vector<double> scores_;
  std::vector<std::uint32_t> rank_of_;
  std::vector<std::uint64_t> pairs_;  // connected contours, both directions
};

}  // namespace thermedge
