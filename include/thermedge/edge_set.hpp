// The result of detection: edgels, edges, junctions. One structure for every preset.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/geometry.hpp"

namespace thermedge {

// Points of edges as a structure of arrays, all of one length; the edgels of an edge are
// consecutive, in walking order. Pixel centres lie at integer coordinates.
struct Edgels {
  std::vector<float> x, y;                   // px
  std::vector<float> nx, ny;                 // unit normal, towards the warmer side (preset paper:
                                             // of the whole edge)
  std::vector<float> magnitude_counts;       // gradient across the edge, counts per px
  std::vector<float> position_sigma_px;      // standard deviation of the position along the normal
  std::vector<std::int32_t> edge;            // index into EdgeSet::edges
  std::vector<std::int32_t> previous, next;  // edgel before and after, -1 at an open end

  [[nodiscard]] std::size_t size() const { return x.size(); }
  void resize(std::size_t count);  // new edgels are all zero
  void reserve(std::size_t count);
};

struct Point {
  float x = 0, y = 0;  // px
};

// The points of one edge in walking order; a view of the arrays above.
class EdgePoints {
 public:
  EdgePoints(const Edgels& edgels, Range range)
      : x_(edgels.x.data() + range.first), y_(edgels.y.data() + range.first), size_(range.count) {}

  class Iterator {
   public:
    using value_type = Point;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    Iterator(const float* x, const float* y) : x_(x), y_(y) {}
    Point operator*() const { return {*x_, *y_}; }
    Iterator& operator++() {
      ++x_;
      ++y_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.x_ == b.x_; }

   private:
    const float* x_ = nullptr;
    const float* y_ = nullptr;
  };

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Point operator[](std::size_t i) const { return {x_[i], y_[i]}; }
  [[nodiscard]] Iterator begin() const { return {x_, y_}; }
  [[nodiscard]] Iterator end() const { return {x_ + size_, y_ + size_}; }

 private:
  const float* x_;
  const float* y_;
  std::size_t size_;
};

struct BoundingBox {
  float x_min = 0, y_min = 0, x_max = 0, y_max = 0;  // px, of the edgel positions
};

// Why an edge was kept or not.
enum class EdgeStatus {
  kKept,           // passed all tests, and is within the budgets
  kBeyondBudget,   // passed all tests, but there were better ones
  kWeak,           // its score is too low
  kInsignificant,  // noise alone makes such edges too often
  kLowContrast,    // its contrast is below the smallest one asked for
};

struct Edge {
  std::int32_t index = 0;  // in EdgeSet::edges; the same as the rank
  std::int32_t rank = 0;   // 0 = best
  double score = 0;        // what edges are ranked by, larger is better: preset paper -ES; others
                           // log(mean suppressed response) + .25 log N
  double display_strength = 0;  // 0..1, falls with the rank, for pictures. By the score, so that it
                                // means the same in every frame; where ES ranks, evenly from 1 to 0
  double es = 0;                // edge score of the paper, eqs. 14-18
  // How sure: z and log10_nfa. How strong: contrast_counts and contrast_sigmas.
  double z = 0;          // contrast across the edge on the frame before denoising, in units of
                         // its standard deviation by noise alone
  double log10_nfa = 0;  // log10 of the expected number of such edges in pure noise
  double length_px = 0;  // arc length
  double contrast_counts = 0;  // mean step across the edge, counts; blur corrected (contrast.hpp)
  double contrast_sigmas = 0;  // the same in units of the noise where the edge lies, whatever the
                               // edge's length; infinite without noise
  bool closed = false;
  // Whether the first, or the last, point is where pixels that are no measurement cut the edge off:
  // the thing that it bounds goes on there.
  bool begins_at_invalid = false;
  bool ends_at_invalid = false;
  bool kept = false;  // status == kKept
  EdgeStatus status = EdgeStatus::kKept;
  BoundingBox box;
  Range edgels;       // in EdgeSet::edgels
  Range corners;      // in EdgeSet::corners
  Range connections;  // in EdgeSet::connections
};

// All edges, those that passed all tests first, each part best first; those within the budgets come
// first of all (`kept`). Flat arrays, reused from frame to frame.
struct EdgeSet {
  Edgels edgels;
  std::vector<Edge> edges;
  std::vector<std::uint32_t> corners;     // index within its edge: 0 = first edgel
  std::vector<std::int32_t> connections;  // indices of connected edges, ascending
  std::vector<Junction> junctions;        // T-junctions
  std::size_t kept = 0;                   // edges[0 .. kept) are within the budgets

  [[nodiscard]] std::span<const Edge> kept_edges() const { return {edges.data(), kept}; }
  [[nodiscard]] EdgePoints points_of(const Edge& edge) const { return {edgels, edge.edgels}; }
  [[nodiscard]] std::span<const std::uint32_t> corners_of(const Edge& edge) const {
    return slice(corners, edge.corners);
  }
  [[nodiscard]] std::span<const std::int32_t> connections_of(const Edge& edge) const {
    return slice(connections, edge.connections);
  }
  void clear();
};

}  // namespace thermedge
