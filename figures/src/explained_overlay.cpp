#include "thermedge/figures/explained_overlay.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "canvas.hpp"
#include "thermedge/io/overlay.hpp"

namespace thermedge::figures {
namespace {

struct Meaning {
  EdgeStatus status;
  std::string_view text;
};
constexpr std::array kMeanings = {
    Meaning{EdgeStatus::kKept, "kept"},
    Meaning{EdgeStatus::kBeyondBudget, "dropped: not among the best (--keep, --max-edgels)"},
    Meaning{EdgeStatus::kLowContrast, "dropped: contrast too low (--min-contrast)"},
    Meaning{EdgeStatus::kInsignificant, "dropped: may be noise (--max-false-alarms)"},
    Meaning{EdgeStatus::kWeak, "dropped: score too low (selection.min_score)"}};

constexpr double kSmallestText = 9;  // points
constexpr double kLargestText = 15;

void draw_legend(Canvas& canvas, const EdgeSet& set, double top, double size) {
  double y = top + 1.5 * size;
  for (const Meaning& meaning : kMeanings) {
    const auto edges = std::count_if(set.edges.begin(), set.edges.end(), [&](const Edge& edge) {
      return edge.status == meaning.status;
    });
    const Box swatch = {size, y - 0.5 * size, 2 * size, 0.35 * size};
    canvas.fill(swatch.inset(-0.25 * size), kInk);  // as on the darkened frame
    canvas.fill(swatch, io::status_colour(meaning.status));
    canvas.text({4 * size, y}, fmt::format("{} {}", edges, meaning.text), {.size = size});
    y += 1.6 * size;
  }
}

}  // namespace

Figure draw_explained_overlay(const Detection& detection, ImageView<const std::uint16_t> counts) {
  Image<Rgb> overlay;
  io::draw_overlay(detection, counts, overlay, io::OverlayContent::kExplained);
  const double width = overlay.width();
  const double height = overlay.height();
  const double size = std::clamp(width / 48, kSmallestText, kLargestText);
  const double legend = (1.6 * static_cast<double>(kMeanings.size()) + 0.8) * size;
  return {width, height + legend, [&](Canvas& canvas) {
            canvas.picture(overlay.view(), {0, 0, width, height});
            draw_legend(canvas, detection.edges, height, size);
          }};
}

}  // namespace thermedge::figures
