// Pictures of what each stage makes of a frame, ready for a Panel.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "sheet.hpp"
#include "thermedge/detector.hpp"

namespace thermedge::figures {

// Functions that draw a picture into a box. The views and references given to the functions below
// must stay valid until it has been called.
using Draw = std::function<void(Canvas&, const Box&)>;

// Counts between the 0.5th and the 99.5th percentile, black to white.
[[nodiscard]] Draw frame_picture(ImageView<const std::uint16_t> counts);

// Levels as they are.
[[nodiscard]] Draw levels_picture(ImageView<const std::uint8_t> levels);

// Edge pixels black on white: thin lines survive printing and scaling best that way.
[[nodiscard]] Draw map_picture(ImageView<const std::uint8_t> edges);

// The frame darkened, as the ground for coloured lines.
[[nodiscard]] Draw dimmed_frame(ImageView<const std::uint16_t> counts);

// Contours, each in a colour that differs from the one found before it.
void draw_contours(Canvas& canvas, const ContourSet& set);

// All contours in one colour.
void draw_contours(Canvas& canvas, const ContourSet& set, Rgb colour);

// Edges from the last to the first, so that the best lies on top.
void draw_edges(Canvas& canvas, const EdgeSet& set, std::span<const Edge> edges,
                const std::function<Rgb(const Edge&)>& colour);

void draw_corners(Canvas& canvas, const EdgeSet& set, Rgb colour);

// How links are marked, by type; the index is the type - 1.
[[nodiscard]] std::span<const LegendEntry> link_marks();
void draw_links(Canvas& canvas, std::span<const Link> links);

}  // namespace thermedge::figures
