#include "thermedge/edge_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace thermedge {
namespace {

// Calls visit(x, y, index) for the pixel that holds each edgel of `range`, where it is inside.
template <class F>
void for_each_pixel(const Edgels& edgels, Range range, int width, int height, F&& visit) {
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    const float x = std::floor(edgels.x[i] + 0.5F);
    const float y = std::floor(edgels.y[i] + 0.5F);
    if (x >= 0 && y >= 0 && x < static_cast<float>(width) && y < static_cast<float>(height)) {
      visit(static_cast<int>(x), static_cast<int>(y), i);
    }
  }
}

// Draws the first `count` edges, the worst first, each in the colour of `colour_of(edge)`.
template <class T, class F>
void draw(const EdgeSet& edges, std::size_t count, ImageView<T> image, F&& colour_of) {
  fill_pixels(image, T{0});
  for (std::size_t i = count; i-- > 0;) {
    const T colour = colour_of(edges.edges[i]);
    for_each_pixel(edges.edgels, edges.edges[i].edgels, image.width(), image.height(),
                   [&](int x, int y, std::size_t) { image(x, y) = colour; });
  }
}

constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();

}  // namespace

MapCount count_fragments(ImageView<const std::uint8_t> map) {
  MapCount count;
  Image<std::uint8_t> left(map.width(), map.height());
  copy_pixels(map, left.view());
  std::vector<Pixel> group;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (left(x, y) == 0) {
        continue;
      }
      ++count.fragments;
      left(x, y) = 0;
      group.assign(1, {x, y});
      for (std::size_t i = 0; i < group.size(); ++i) {
        const Pixel at = group[i];
        for (int v = std::max(0, at.y - 1); v <= std::min(map.height() - 1, at.y + 1); ++v) {
          for (int u = std::max(0, at.x - 1); u <= std::min(map.width() - 1, at.x + 1); ++u) {
            if (left(u, v) != 0) {
              left(u, v) = 0;
              group.push_back({u, v});
            }
          }
        }
      }
      count.edge_pixels += group.size();
    }
  }
  return count;
}

void draw_mask(const EdgeSet& edges, ImageView<std::uint8_t> mask) {
  draw(edges, edges.kept, mask, [](const Edge&) { return std::uint8_t{255}; });
}

void draw_labels(const EdgeSet& edges, ImageView<std::uint16_t> labels) {
  constexpr std::int32_t kLargest = std::numeric_limits<std::uint16_t>::max();
  draw(edges, edges.kept, labels, [](const Edge& edge) {
    return static_cast<std::uint16_t>(std::min(edge.index, kLargest - 1) + 1);
  });
}

void draw_strength(const EdgeSet& edges, ImageView<std::uint8_t> strength) {
  draw(edges, edges.edges.size(), strength, [](const Edge& edge) {
    return static_cast<std::uint8_t>(
        std::lround(1 + 254 * std::clamp(edge.display_strength, 0.0, 1.0)));
  });
}

void DistanceTransform::run(const EdgeSet& edges, int width, int height, float max_distance_px,
                            DistanceField& field) {
  field.distance_px.resize(width, height);
  field.nearest.resize(width, height);
  nearest_.resize(width, height);
  reigns_.reserve(static_cast<std::size_t>(width) + 1);
  place_edgels(edges);
  search_columns();
  for (int y = 0; y < height; ++y) {
    find_reigns(y);
    fill_row(y, max_distance_px, field);
  }
}

void DistanceTransform::place_edgels(const EdgeSet& edges) {
  edgels_ = static_cast<std::int64_t>(edges.edgels.size());
  fill_pixels(nearest_.view(), ColumnNearest{kFar, -1});
  for (const Edge& edge : edges.kept_edges()) {
    for_each_pixel(edges.edgels, edge.edgels, nearest_.width(), nearest_.height(),
                   [&](int x, int y, std::size_t i) {
                     ColumnNearest& pixel = nearest_(x, y);
                     const auto edgel = static_cast<std::int32_t>(i);
                     if (pixel.edgel < 0 || edgel < pixel.edgel) {
                       pixel = {0, edgel};
                     }
                   });
  }
}

// Downwards, then upwards, each pixel learns from its neighbour in the column.
void DistanceTransform::search_columns() {
  const auto learn = [&](int y, int neighbour_y) {
    ColumnNearest* row = nearest_.row(y);
    const ColumnNearest* neighbour = nearest_.row(neighbour_y);
    for (int x = 0; x < nearest_.width(); ++x) {
      if (neighbour[x].edgel < 0) {
        continue;
      }
      const ColumnNearest offer{neighbour[x].distance + 1, neighbour[x].edgel};
      if (offer.distance < row[x].distance ||
          (offer.distance == row[x].distance && offer.edgel < row[x].edgel)) {
        row[x] = offer;
      }
    }
  };
  for (int y = 1; y < nearest_.height(); ++y) {
    learn(y, y - 1);
  }
  for (int y = nearest_.height() - 2; y >= 0; --y) {
    learn(y, y + 1);
  }
}

// Which column is nearest, along one row: the lower envelope of the parabolas
//   cost(x) = n ((x - column)^2 + distance^2) + edgel,   n > all indices of edgels.
// The index breaks ties, so no two costs are equal at a pixel, and whole numbers will do: a column
// to the right is cheaper than another from the first pixel past the crossing of the parabolas.
void DistanceTransform::find_reigns(int y) {
  const ColumnNearest* row = nearest_.row(y);
  const auto height_at_zero = [&](std::int64_t column) {
    const ColumnNearest& nearest = row[column];
    const std::int64_t distance = nearest.distance;
    return edgels_ * (column * column + distance * distance) + nearest.edgel;
  };
  reigns_.clear();
  for (int column = 0; column < nearest_.width(); ++column) {
    if (row[column].edgel < 0) {
      continue;
    }
    std::int32_t begin = 0;
    while (!reigns_.empty()) {
      const Reign& left = reigns_.back();
      const std::int64_t rise = height_at_zero(column) - height_at_zero(left.column);
      const std::int64_t run = 2 * edgels_ * (column - left.column);
      const std::int64_t crossing = rise >= 0 ? rise / run : -((-rise + run - 1) / run);
      begin =
          static_cast<std::int32_t>(std::clamp<std::int64_t>(crossing + 1, 0, nearest_.width()));
      if (begin > left.begin) {
        break;
      }
      reigns_.pop_back();
      begin = 0;
    }
    if (begin < nearest_.width()) {
      reigns_.push_back({column, begin});
    }
  }
}

void DistanceTransform::fill_row(int y, float max_distance_px, DistanceField& field) const {
  const double max_squared = static_cast<double>(max_distance_px) * max_distance_px;
  const ColumnNearest* row = nearest_.row(y);
  float* distance_px = field.distance_px.row(y);
  std::int32_t* nearest = field.nearest.row(y);
  std::fill_n(distance_px, nearest_.width(), max_distance_px);
  std::fill_n(nearest, nearest_.width(), -1);
  for (std::size_t i = 0; i < reigns_.size(); ++i) {
    const std::int32_t column = reigns_[i].column;
    const std::int32_t end = i + 1 < reigns_.size() ? reigns_[i + 1].begin : nearest_.width();
    const std::int64_t down = row[column].distance;
    for (std::int32_t x = reigns_[i].begin; x < end; ++x) {
      const std::int64_t across = x - column;
      const auto squared = static_cast<double>(across * across + down * down);
      if (squared <= max_squared) {
        distance_px[x] = static_cast<float>(std::sqrt(squared));
        nearest[x] = row[column].edgel;
      }
    }
  }
}

}  // namespace thermedge
