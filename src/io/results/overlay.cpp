#include "thermedge/io/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "thermedge/io/colour_map.hpp"
#include "thermedge/io/tracks_file.hpp"

namespace thermedge::io {
namespace {

constexpr int kScale = 2;
constexpr int kLeastRangeCounts = 16;

struct Stretch {
  int low = 0;
  int high = 0;
};

Stretch percentile_stretch(ImageView<const std::uint16_t> counts) {
  std::vector<std::size_t> histogram(65536, 0);
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      ++histogram[counts(x, y)];
    }
  }
  const auto percentile = [&](double share) {
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(counts.size() - 1));
    std::size_t below = 0;
    int value = 0;
    while ((below += histogram[static_cast<std::size_t>(value)]) <= wanted) {
      ++value;
    }
    return value;
  };
  Stretch stretch{percentile(0.005), percentile(0.995)};
  const int missing = kLeastRangeCounts - (stretch.high - stretch.low);
  if (missing > 0) {
    stretch.low -= missing / 2;
    stretch.high = stretch.low + kLeastRangeCounts;
  }
  return stretch;
}

// Draws on the enlarged picture in coordinates of the frame; what lies outside is left out.
class Canvas {
 public:
  explicit Canvas(ImageView<Rgb> picture) : picture_(picture) {}

  void dot(int x, int y, Rgb colour) {
    if (picture_.contains(x, y)) {
      picture_(x, y) = colour;
    }
  }

  void line(float x0, float y0, float x1, float y1, Rgb colour) {
    const float ax = enlarged(x0), ay = enlarged(y0), bx = enlarged(x1), by = enlarged(y1);
    const int steps =
        std::max(1, static_cast<int>(std::ceil(std::max(std::abs(bx - ax), std::abs(by - ay)))));
    for (int i = 0; i <= steps; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(steps);
      dot(static_cast<int>(std::lround(ax + (bx - ax) * t)),
          static_cast<int>(std::lround(ay + (by - ay) * t)), colour);
    }
  }

  void square(float x, float y, Rgb colour) {
    const int cx = static_cast<int>(std::lround(enlarged(x)));
    const int cy = static_cast<int>(std::lround(enlarged(y)));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        dot(cx + dx, cy + dy, colour);
      }
    }
  }

  void ring(float x, float y, Rgb colour) {
    const int cx = static_cast<int>(std::lround(enlarged(x)));
    const int cy = static_cast<int>(std::lround(enlarged(y)));
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        const int squared = dx * dx + dy * dy;
        if (squared >= 7 && squared <= 11) {
          dot(cx + dx, cy + dy, colour);
        }
      }
    }
  }

 private:
  // The centre of pixel x lies in the middle of its enlarged square.
  static float enlarged(float position) {
    return (position + 0.5F) * static_cast<float>(kScale) - 0.5F;
  }
  ImageView<Rgb> picture_;
};

void draw_background(const Detection& detection, ImageView<const std::uint16_t> counts,
                     ImageView<Rgb> picture) {
  Image<std::uint8_t> view(detection.width, detection.height);
  if (!counts.empty()) {
    draw_view(counts, view);
  } else {
    fill_pixels(view.view(), std::uint8_t{0});
  }
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const auto grey =
          static_cast<std::uint8_t>(std::lround(20 + 180 * (view(x / kScale, y / kScale) / 255.0)));
      picture(x, y) = {grey, grey, grey};
    }
  }
}

// `colour_at(i)`: of the line from edgel i on.
template <class Colour>
void draw_edge(const EdgeSet& set, const Edge& edge, Colour&& colour_at, Canvas& canvas) {
  const Edgels& e = set.edgels;
  const std::uint32_t first = edge.edgels.first;
  const std::uint32_t last = first + edge.edgels.count - 1;
  for (std::uint32_t i = first; i <= last; ++i) {
    const std::uint32_t next = i < last ? i + 1 : (edge.closed ? first : last);
    canvas.line(e.x[i], e.y[i], e.x[next], e.y[next], colour_at(i));
  }
}

void draw_edge(const EdgeSet& set, const Edge& edge, Rgb colour, Canvas& canvas) {
  draw_edge(
      set, edge, [=](std::uint32_t) { return colour; }, canvas);
}

void draw_corners(const EdgeSet& set, const Edge& edge, Canvas& canvas) {
  for (const std::uint32_t corner : set.corners_of(edge)) {
    const std::uint32_t at = edge.edgels.first + corner;
    canvas.square(set.edgels.x[at], set.edgels.y[at], {255, 255, 255});
  }
}

}  // namespace

void draw_view(ImageView<const std::uint16_t> counts, ImageView<std::uint8_t> view) {
  if (counts.empty()) {
    return;
  }
  const Stretch stretch = percentile_stretch(counts);
  const double gain = 255.0 / (stretch.high - stretch.low);
  for (int y = 0; y < counts.height(); ++y) {
    std::transform(counts.row(y), counts.row(y) + counts.width(), view.row(y),
                   [&](std::uint16_t count) {
                     return static_cast<std::uint8_t>(
                         std::clamp((count - stretch.low) * gain + 0.5, 0.0, 255.0));
                   });
  }
}

Rgb rank_colour(double share) {
  constexpr double kLast = 0.4;  // darker ones would be lost on the darkened frame
  return plasma(1 - (1 - kLast) * std::clamp(share, 0.0, 1.0));
}

Rgb status_colour(EdgeStatus status) {
  switch (status) {
    case EdgeStatus::kKept:
      break;
    case EdgeStatus::kBeyondBudget:
      return {70, 150, 255};
    case EdgeStatus::kWeak:
      return {190, 120, 220};
    case EdgeStatus::kInsignificant:
      return {235, 80, 70};
    case EdgeStatus::kLowContrast:
      return {0, 200, 130};
  }
  return rank_colour(0);
}

void draw_overlay(const Detection& detection, ImageView<const std::uint16_t> counts,
                  Image<Rgb>& overlay, OverlayContent content) {
  overlay.resize(detection.width * kScale, detection.height * kScale);
  draw_background(detection, counts, overlay);
  Canvas canvas(overlay);
  const EdgeSet& set = detection.edges;
  const bool explained = content == OverlayContent::kExplained;
  for (std::size_t i = set.edges.size(); explained && i-- > set.kept;) {
    draw_edge(set, set.edges[i], status_colour(set.edges[i].status), canvas);
  }
  const double last = std::max<double>(1.0, static_cast<double>(set.kept) - 1);
  // Best last, so that it lies on top.
  for (std::size_t i = set.kept; i-- > 0;) {
    const double share = explained ? 0 : static_cast<double>(i) / last;
    draw_edge(set, set.edges[i], rank_colour(share), canvas);
    draw_corners(set, set.edges[i], canvas);
  }
  for (const Junction& junction : set.junctions) {
    canvas.ring(static_cast<float>(junction.at.x), static_cast<float>(junction.at.y),
                {90, 220, 255});
  }
}

Rgb track_colour(std::int64_t track) {
  constexpr std::array kOkabeIto = {Rgb{230, 159, 0},  Rgb{86, 180, 233}, Rgb{0, 158, 115},
                                    Rgb{240, 228, 66}, Rgb{0, 114, 178},  Rgb{213, 94, 0},
                                    Rgb{204, 121, 167}};
  // Neighbours in number are often neighbours in the picture: the same colour comes late.
  return kOkabeIto[static_cast<std::size_t>(track) % kOkabeIto.size()];
}

void draw_tracks(const TrackedFrame& frame, ImageView<const std::uint16_t> counts,
                 Image<Rgb>& overlay) {
  constexpr Rgb kNoTrack = {130, 130, 130};
  const Detection& detection = frame.detection;
  overlay.resize(detection.width * kScale, detection.height * kScale);
  draw_background(detection, counts, overlay);
  Canvas canvas(overlay);
  const auto colour_at = [&](std::uint32_t edgel) {
    const std::int64_t track = frame.tracks.track[edgel];
    return track >= 0 ? track_colour(track) : kNoTrack;
  };
  for (const Edge& edge : detection.edges.kept_edges()) {
    draw_edge(detection.edges, edge, colour_at, canvas);
  }
}

}  // namespace thermedge::io
