#include "frame_panels.hpp"

#include <algorithm>
#include <array>

#include "thermedge/io/overlay.hpp"

namespace thermedge::figures {
namespace {

constexpr double kLinePx = 1;
constexpr int kDimmedWhite = 130;  // of 255

// Draws `pixel(x, y)` of every pixel.
template <class Pixel>
void draw_pixels(Canvas& canvas, const Box& box, int width, int height, Pixel&& pixel) {
  Image<Rgb> picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture(x, y) = pixel(x, y);
    }
  }
  canvas.picture(picture.view(), box);
}

Rgb grey(int level) {
  const auto value = static_cast<std::uint8_t>(level);
  return {value, value, value};
}

void draw_view_of(Canvas& canvas, const Box& box, ImageView<const std::uint16_t> counts,
                  int white) {
  Image<std::uint8_t> view(counts.width(), counts.height());
  io::draw_view(counts, view);
  draw_pixels(canvas, box, view.width(), view.height(),
              [&](int x, int y) { return grey(view(x, y) * white / 255); });
}

template <class Points>
std::vector<Point> to_points(const Points& pixels) {
  std::vector<Point> points;
  points.reserve(pixels.size());
  for (const Pixel& pixel : pixels) {
    points.push_back({static_cast<double>(pixel.x), static_cast<double>(pixel.y)});
  }
  return points;
}

}  // namespace

Draw frame_picture(ImageView<const std::uint16_t> counts) {
  return [=](Canvas& canvas, const Box& box) { draw_view_of(canvas, box, counts, 255); };
}

Draw dimmed_frame(ImageView<const std::uint16_t> counts) {
  return [=](Canvas& canvas, const Box& box) { draw_view_of(canvas, box, counts, kDimmedWhite); };
}

Draw levels_picture(ImageView<const std::uint8_t> levels) {
  return [=](Canvas& canvas, const Box& box) {
    draw_pixels(canvas, box, levels.width(), levels.height(),
                [&](int x, int y) { return grey(levels(x, y)); });
  };
}

Draw map_picture(ImageView<const std::uint8_t> edges) {
  return [=](Canvas& canvas, const Box& box) {
    draw_pixels(canvas, box, edges.width(), edges.height(),
                [&](int x, int y) { return edges(x, y) != 0 ? kInk : kPaper; });
  };
}

void draw_contours(Canvas& canvas, const ContourSet& set) {
  for (std::size_t i = 0; i < set.items.size(); ++i) {
    const Contour& contour = set.items[i];
    canvas.line(to_points(set.pixels(contour)), contour.closed, category_colour(i), kLinePx);
  }
}

void draw_contours(Canvas& canvas, const ContourSet& set, Rgb colour) {
  for (const Contour& contour : set.items) {
    canvas.line(to_points(set.pixels(contour)), contour.closed, colour, kLinePx);
  }
}

void draw_edges(Canvas& canvas, const EdgeSet& set, std::span<const Edge> edges,
                const std::function<Rgb(const Edge&)>& colour) {
  std::vector<Point> points;
  for (std::size_t i = edges.size(); i-- > 0;) {
    const Range range = edges[i].edgels;
    points.clear();
    for (std::uint32_t at = range.first; at < range.first + range.count; ++at) {
      points.push_back({set.edgels.x[at], set.edgels.y[at]});
    }
    canvas.line(points, edges[i].closed, colour(edges[i]), kLinePx);
  }
}

void draw_corners(Canvas& canvas, const EdgeSet& set, Rgb colour) {
  for (const Edge& edge : set.edges) {
    for (const std::uint32_t corner : set.corners_of(edge)) {
      const std::uint32_t at = edge.edgels.first + corner;
      canvas.mark(Mark::kSquare, {set.edgels.x[at], set.edgels.y[at]}, 3, colour);
    }
  }
}

std::span<const LegendEntry> link_marks() {
  static const std::array<LegendEntry, 3> kMarks = {
      LegendEntry{Mark::kDisc, category_colour(3), "end to end"},
      LegendEntry{Mark::kTriangle, category_colour(1), "end to middle"},
      LegendEntry{Mark::kDiamond, category_colour(4), "loop"}};
  return kMarks;
}

void draw_links(Canvas& canvas, std::span<const Link> links) {
  for (const Link& link : links) {
    const LegendEntry& entry = link_marks()[static_cast<std::size_t>(link.type) - 1];
    const Point middle = {(link.from.x + link.to.x) / 2.0, (link.from.y + link.to.y) / 2.0};
    canvas.mark(entry.mark, middle, 6.5, kInk);
    canvas.mark(entry.mark, middle, 5, entry.colour);
  }
}

}  // namespace thermedge::figures
