#include "thermedge/stages/contours.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "pixel_window.hpp"

namespace thermedge {
namespace {

// What a pixel of the map holds.
constexpr std::uint8_t kClear = 0;
constexpr std::uint8_t kSet = 1;
constexpr std::uint8_t kChecked = 2;  // set, in a component that is large enough

constexpr std::int32_t kNobody = -1;

// "More than (width + height) / 25 pixels", or what the option says.
std::size_t shortest_curve(const ContourOptions& options, int width, int height) {
  if (options.min_length_px > 0) {
    return static_cast<std::size_t>(options.min_length_px);
  }
  return (static_cast<std::size_t>(width) + static_cast<std::size_t>(height)) / 25 + 1;
}

bool ends_meet(Pixel first, Pixel last, double gap_px) {
  return static_cast<double>(squared_distance(first, last)) < gap_px * gap_px;
}

}  // namespace

Status ContourOptions::check() const { return check_ranges(*this, "contours."); }

void ContourSet::clear() {
  points.clear();
  items.clear();
  junctions.clear();
}

Status ContourTracer::run(ImageView<const std::uint8_t> edges, ContourSet& contours) {
  contours.clear();
  if (Status status = options_.check(); !status) {
    return status;
  }
  if (edges.size() > std::numeric_limits<std::int32_t>::max()) {
    return failure(ErrorCode::kLimitExceeded,
                   "edge map: " + std::to_string(edges.size()) + " pixels; at most 2^31 - 1");
  }
  prepare(edges, contours);
  if (options_.min_component_px > 1) {
    remove_small_components();
  }
  for (std::int32_t x = 0; x < edges.width(); ++x) {
    for (std::int32_t y = 0; y < edges.height(); ++y) {
      if (map_(x + options_.gap_px, y + options_.gap_px) != kClear) {
        trace({x, y}, contours);
      }
    }
  }
  find_junctions(contours);
  return {};
}

// Every pixel belongs to one curve at most, which bounds all the arrays.
void ContourTracer::prepare(ImageView<const std::uint8_t> edges, ContourSet& contours) {
  const int gap = options_.gap_px;
  min_points_ = shortest_curve(options_, edges.width(), edges.height());
  contours.points.reserve(edges.size());
  contours.items.reserve(edges.size() / min_points_);
  contours.junctions.reserve(2 * (edges.size() / min_points_));
  visited_.reserve(edges.size());
  detail::list_offsets(
      gap, [](Pixel offset) { return offset != Pixel{}; }, steps_);
  const std::int64_t reach = gap + 1;
  detail::list_offsets(
      gap + 1, [=](Pixel offset) { return squared_distance(offset, {}) <= reach * reach; },
      touching_);

  map_.resize(edges.width() + 2 * gap, edges.height() + 2 * gap);
  fill_pixels(map_.view(), kClear);
  for (int y = 0; y < edges.height(); ++y) {
    std::transform(edges.row(y), edges.row(y) + edges.width(), map_.row(y + gap) + gap,
                   [](std::uint8_t value) { return value != 0 ? kSet : kClear; });
  }
}

void ContourTracer::remove_small_components() {
  const auto enough = static_cast<std::size_t>(options_.min_component_px);
  for (std::int32_t y = 0; y < map_.height(); ++y) {
    for (std::int32_t x = 0; x < map_.width(); ++x) {
      if (map_(x, y) != kSet) {
        continue;
      }
      collect_component({x, y});
      if (visited_.size() < enough) {
        for (const Pixel pixel : visited_) {
          map_(pixel.x, pixel.y) = kClear;
        }
      }
    }
  }
}

// Fills `visited_` with the 8-connected component of `seed`, in coordinates of the map. The border
// of the map is clear, so that neighbours need no check.
void ContourTracer::collect_component(Pixel seed) {
  visited_.clear();
  visited_.push_back(seed);
  map_(seed.x, seed.y) = kChecked;
  for (std::size_t next = 0; next < visited_.size(); ++next) {
    const Pixel at = visited_[next];
    for (std::int32_t y = at.y - 1; y <= at.y + 1; ++y) {
      for (std::int32_t x = at.x - 1; x <= at.x + 1; ++x) {
        if (map_(x, y) == kSet) {
          map_(x, y) = kChecked;
          visited_.push_back({x, y});
        }
      }
    }
  }
}

// Walks both ways from `seed` and keeps the curve if it is long enough.
void ContourTracer::trace(Pixel seed, ContourSet& contours) {
  std::vector<Pixel>& points = contours.points;
  const std::size_t first = points.size();
  map_(seed.x + options_.gap_px, seed.y + options_.gap_px) = kClear;
  points.push_back(seed);
  walk(seed, points);
  visited_.clear();
  walk(seed, visited_);
  const std::size_t count = points.size() - first + visited_.size();
  if (count < min_points_) {
    points.resize(first);
    return;
  }
  points.insert(points.begin() + static_cast<std::ptrdiff_t>(first), visited_.rbegin(),
                visited_.rend());
  Contour contour;
  contour.points = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)};
  contour.closed = ends_meet(points[first], points.back(), options_.closed_gap_px);
  contours.items.push_back(contour);
}

// Appends what is visited behind `from`.
void ContourTracer::walk(Pixel from, std::vector<Pixel>& visited) {
  const int gap = options_.gap_px;
  const auto is_set = [&](Pixel step) {
    return map_(from.x + gap + step.x, from.y + gap + step.y) != kClear;
  };
  for (auto step = std::find_if(steps_.begin(), steps_.end(), is_set); step != steps_.end();
       step = std::find_if(steps_.begin(), steps_.end(), is_set)) {
    from = {from.x + step->x, from.y + step->y};
    map_(from.x + gap, from.y + gap) = kClear;
    visited.push_back(from);
  }
}

void ContourTracer::find_junctions(ContourSet& contours) {
  const int border = options_.gap_px + 1;
  owner_.resize(map_.width() + 2, map_.height() + 2);
  fill_pixels(owner_.view(), kNobody);
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    for (const Pixel pixel : contours.pixels(contours.items[i])) {
      owner_(pixel.x + border, pixel.y + border) = static_cast<std::int32_t>(i);
    }
  }
  const auto touches_another = [&](Pixel end, std::int32_t self) {
    return std::any_of(touching_.begin(), touching_.end(), [&](Pixel offset) {
      const std::int32_t owner = owner_(end.x + border + offset.x, end.y + border + offset.y);
      return owner != kNobody && owner != self;
    });
  };
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    const auto pixels = contours.pixels(contours.items[i]);
    for (const Pixel end : {pixels.front(), pixels.back()}) {
      if (!contours.items[i].closed && touches_another(end, static_cast<std::int32_t>(i))) {
        contours.junctions.push_back({end});
      }
    }
  }
}

}  // namespace thermedge
