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
  std::vector<std::int32_t> previous, next;  // edgel before and behind, -1 at an open end

  [[nodiscard]] std::size_t size() const { return x.size(); }
  void resize(std::size_t count);  // new edgels are all zero
  void reserve(std::size_t count);
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
};

struct Edge {
  std::int32_t index = 0;  // in EdgeSet::edges; the same as the rank
  std::int32_t rank = 0;   // 0 = best
  double score =
      0;  // what edges are ranked by: ES, smaller is better; or, of edge pixels
          // by oriented kernels, log(mean suppressed_response) + .25 log N, larger is better
  double display_strength = 0;  // 0..1, falls with the rank, for pictures. By the score, so that it
                                // means the same in every frame; where ES ranks, evenly from 1 to 0
  double es = 0;         // edge score of the paper, eqs. 14-18
  double z = 0;          // contrast across the edge on the frame before denoising, in units of
                         // its standard deviation by noise alone
  double log10_nfa = 0;  // log10 of the expected number of such edges in pure noise
  double length_px = 0;  // arc length
  double contrast_counts = 0;  // mean step across the edge, counts
  bool closed = false;
  bool kept = false;  // status == kKept
  EdgeStatus status = EdgeStatus::kKept;
  BoundingBox box;
  Range edgels;             // in EdgeSet::edgels
  Range corners;            // in EdgeSet::corners
  Range connections;        // in EdgeSet::connections
  std::int32_t track = -1;  // identity over time, -1 where no tracker ran
  std::int32_t age = 0;     // frames since the track began
};

// All edges, those that passed all tests first, each part best first; those within the budgets come
// first of all (`kept`). Flat arrays, reused from frame to frame.
struct EdgeSet {
  Edgels edgels;
  std::vector<Edge> edges;
  std::vector<std::uint32_t> corners;     // index within its edge: 0 = first edgel
  std::vector<std::int32_t> connections;  // ids of connected edges, ascending
  std::vector<Junction> junctions;        // T-junctions
  std::size_t kept = 0;                   // edges[0 .. kept) are within the budgets

  [[nodiscard]] std::span<const Edge> kept_edges() const { return {edges.data(), kept}; }
  [[nodiscard]] std::span<const std::uint32_t> corners_of(const Edge& edge) const {
    return slice(corners, edge.corners);
  }
  [[nodiscard]] std::span<const std::int32_t> connections_of(const Edge& edge) const {
    return slice(connections, edge.connections);
  }
  void clear();
};

}  // namespace thermedge
