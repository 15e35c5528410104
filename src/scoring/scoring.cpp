#include "thermedge/stages/scoring.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace thermedge {
namespace {

struct FittedParts {
  double residual = 0;      // sum of RSS over the parts
  std::size_t corners = 1;  // M
};

// Fits the parts of a curve between its corners, its ends being corners as well.
FittedParts fit_parts(std::span<const Pixel> pixels, std::span<const std::uint32_t> corners) {
  FittedParts parts;
  std::size_t from = 0;
  const auto fit_to = [&](std::size_t to) {
    if (to > from) {
      parts.residual += cubic_residual(pixels.subspan(from, to - from + 1));
      ++parts.corners;
      from = to;
    }
  };
  for (const std::uint32_t corner : corners) {
    fit_to(corner);
  }
  fit_to(pixels.size() - 1);
  return parts;
}

double arc_length(std::span<const Pixel> pixels, bool closed) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < pixels.size(); ++i) {
    length += std::sqrt(static_cast<double>(squared_distance(pixels[i], pixels[i + 1])));
  }
  if (closed) {
    length += std::sqrt(static_cast<double>(squared_distance(pixels.back(), pixels.front())));
  }
  return length;
}

// Appends the pixels of the edge at `index` as edgels, one after the other.
Range append_edgels(std::span<const Pixel> pixels, bool closed, std::size_t index, Edgels& edgels) {
  const std::size_t first = edgels.size();
  const std::size_t last = first + pixels.size() - 1;
  edgels.resize(last + 1);
  for (std::size_t i = first; i <= last; ++i) {
    edgels.x[i] = static_cast<float>(pixels[i - first].x);
    edgels.y[i] = static_cast<float>(pixels[i - first].y);
    edgels.edge[i] = static_cast<std::int32_t>(index);
    edgels.previous[i] = static_cast<std::int32_t>(i) - 1;
    edgels.next[i] = static_cast<std::int32_t>(i) + 1;
  }
  edgels.previous[first] = closed ? static_cast<std::int32_t>(last) : -1;
  edgels.next[last] = closed ? static_cast<std::int32_t>(first) : -1;
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(pixels.size())};
}

BoundingBox bounding_box(std::span<const Pixel> pixels) {
  const auto [left, right] =
      std::minmax_element(pixels.begin(), pixels.end(), [](Pixel a, Pixel b) { return a.x < b.x; });
  const auto [top, bottom] =
      std::minmax_element(pixels.begin(), pixels.end(), [](Pixel a, Pixel b) { return a.y < b.y; });
  return {static_cast<float>(left->x), static_cast<float>(top->y), static_cast<float>(right->x),
          static_cast<float>(bottom->y)};
}

}  // namespace

Status ScoringOptions::check() const { return check_ranges(*this, "scoring."); }

double edge_score(const EdgeScoreTerms& terms) {
  return terms.average_residual * terms.width * terms.height * terms.corners * terms.corners /
         (terms.points * terms.points * terms.connected_points * terms.loop_line_ratio);
}

double saliency(std::span<const Pixel> pixels, ImageView<const float> suppressed_response,
                const ScoringTuning& tuning) {
  double sum = 0;
  int count = 0;
  for (const Pixel pixel : pixels) {
    const double value = suppressed_response(pixel.x, pixel.y);
    sum += std::max(value, 0.0);
    count += value > 0 ? 1 : 0;
  }
  return std::log(std::max(sum / std::max(count, 1), tuning.least_mean)) +
         tuning.length_weight * std::log(static_cast<double>(pixels.size()));
}

Status Scorer::run(const LinkedContours& linked, const CornerSet& corners, int width, int height,
                   EdgeSet& edges) {
  return score_contours(linked, corners, width, height, edges).map([&] {
    fill(linked, corners, edges);
  });
}

Status Scorer::run(const LinkedContours& linked, const CornerSet& corners,
                   ImageView<const float> suppressed_response, EdgeSet& edges) {
  return score_contours(linked, corners, suppressed_response.width(), suppressed_response.height(),
                        edges)
      .map([&] {
        score_by_saliency(linked.contours, suppressed_response);
        fill(linked, corners, edges);
        const double faintest = tuning_.faintest_score;
        for (Edge& edge : edges.edges) {
          edge.display_strength =
              std::clamp((edge.score - faintest) / (tuning_.strongest_score - faintest), 0.0, 1.0);
        }
      });
}

void Scorer::score_by_saliency(const ContourSet& contours,
                               ImageView<const float> suppressed_response) {
  for (Ranked& ranked : order_) {
    ranked.score =
        saliency(contours.pixels(contours.items[ranked.contour]), suppressed_response, tuning_);
  }
}

// Fills `edges` in the order of their rank.
void Scorer::fill(const LinkedContours& linked, const CornerSet& corners, EdgeSet& edges) {
  rank_contours();
  for (std::size_t rank = 0; rank < order_.size(); ++rank) {
    append_edge(linked, corners, rank, edges);
  }
  set_connections(edges);
  edges.junctions.assign(linked.contours.junctions.begin(), linked.contours.junctions.end());
}

void Scorer::prepare(const LinkedContours& linked, const CornerSet& corners, EdgeSet& edges) {
  const std::size_t most_contours = linked.contours.items.capacity();
  const std::size_t most_connections = 2 * linked.links.capacity();
  connections_.reserve(most_connections);
  order_.reserve(most_contours);
  rank_of_.reserve(most_contours);
  edges.edgels.reserve(linked.contours.points.capacity());
  edges.edges.reserve(most_contours);
  edges.corners.reserve(corners.indices.capacity());
  edges.connections.reserve(most_connections);
  edges.junctions.reserve(linked.contours.junctions.capacity());
}

void Scorer::collect_connections(const LinkedContours& linked) {
  connections_.clear();
  for (const Link& link : linked.links) {
    if (link.type == LinkType::kEndToMiddle) {
      connections_.push_back({link.a, link.b});
      connections_.push_back({link.b, link.a});
    }
  }
  std::sort(connections_.begin(), connections_.end());
  connections_.erase(std::unique(connections_.begin(), connections_.end()), connections_.end());
}

// By ES.
Status Scorer::score_contours(const LinkedContours& linked, const CornerSet& corners,
                              double frame_width, double frame_height, EdgeSet& edges) {
  edges.clear();
  if (Status status = options_.check(); !status) {
    return status;
  }
  assert(corners.ranges.size() == linked.contours.items.size());
  prepare(linked, corners, edges);
  collect_connections(linked);
  order_.clear();
  auto connection = connections_.begin();
  for (std::uint32_t i = 0; i < linked.contours.items.size(); ++i) {
    const Contour& contour = linked.contours.items[i];
    const FittedParts parts =
        fit_parts(linked.contours.pixels(contour), slice(corners.indices, corners.ranges[i]));
    EdgeScoreTerms terms;
    terms.average_residual = parts.residual / contour.points.count;
    terms.width = frame_width;
    terms.height = frame_height;
    terms.points = contour.points.count;
    terms.corners = static_cast<double>(parts.corners);
    terms.connected_points = contour.points.count;
    for (; connection != connections_.end() && connection->from == i; ++connection) {
      terms.connected_points += linked.contours.items[connection->to].points.count;
    }
    terms.loop_line_ratio = contour.closed ? options_.loop_line_ratio : 1;
    const double es = edge_score(terms);
    order_.push_back({0 - es, es, contour.points.count, i});
  }
  return {};
}

void Scorer::rank_contours() {
  std::sort(order_.begin(), order_.end(), [](const Ranked& a, const Ranked& b) {
    return std::tie(b.score, b.points, a.contour) < std::tie(a.score, a.points, b.contour);
  });
  rank_of_.resize(order_.size());
  for (std::size_t rank = 0; rank < order_.size(); ++rank) {
    rank_of_[order_[rank].contour] = static_cast<std::uint32_t>(rank);
  }
}

void Scorer::append_edge(const LinkedContours& linked, const CornerSet& corners, std::size_t rank,
                         EdgeSet& edges) const {
  const Ranked& ranked = order_[rank];
  const Contour& contour = linked.contours.items[ranked.contour];
  const auto pixels = linked.contours.pixels(contour);
  const auto indices = slice(corners.indices, corners.ranges[ranked.contour]);
  Edge edge;
  edge.index = edge.rank = static_cast<std::int32_t>(rank);
  edge.score = ranked.score;
  edge.display_strength =
      1 - static_cast<double>(rank) / std::max(static_cast<double>(order_.size()) - 1, 1.0);
  edge.es = ranked.es;
  edge.length_px = arc_length(pixels, contour.closed);
  edge.closed = contour.closed;
  edge.box = bounding_box(pixels);
  edge.edgels = append_edgels(pixels, contour.closed, rank, edges.edgels);
  edge.corners = {static_cast<std::uint32_t>(edges.corners.size()),
                  static_cast<std::uint32_t>(indices.size())};
  edges.corners.insert(edges.corners.end(), indices.begin(), indices.end());
  edges.edges.push_back(edge);
}

void Scorer::set_connections(EdgeSet& edges) {
  for (Connection& connection : connections_) {
    connection = {rank_of_[connection.from], rank_of_[connection.to]};
  }
  std::sort(connections_.begin(), connections_.end());
  auto connection = connections_.begin();
  for (std::uint32_t rank = 0; rank < edges.edges.size(); ++rank) {
    Range& range = edges.edges[rank].connections;
    range.first = static_cast<std::uint32_t>(edges.connections.size());
    for (; connection != connections_.end() && connection->from == rank; ++connection) {
      edges.connections.push_back(static_cast<std::int32_t>(connection->to));
      ++range.count;
    }
  }
}

}  // namespace thermedge
