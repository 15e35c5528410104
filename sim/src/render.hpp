// From a scene to pictures and true edges.
#pragma once

#include <vector>

#include "shapes.hpp"
#include "thermedge/image.hpp"

namespace thermedge::sim {

// Share of each pixel that the outline covers, 0..1, exact but for rounding: every side adds its
// signed area to the cells that it crosses, and the row is summed up. Pixel (x, y) of `coverage` is
// the unit square around (x, y) + origin.
void cover(const Outline& outline, Point origin, ImageView<double> coverage);

// Counts averaged over each pixel (the aperture), then blurred by a Gaussian of blur_px (the
// optics). The scene goes on beyond the frame, so its border is blurred like the rest.
[[nodiscard]] Image<float> render_clean(const Scene& scene, int width, int height, double blur_px);

// Gaussian blur, normalised, clamped at the borders; works in place.
void blur(ImageView<double> image, double sigma_px);

// Visible outlines of the scene inside the frame where the step across is at least
// `least_step_counts`.
[[nodiscard]] std::vector<TrueEdge> true_edges(const Scene& scene, int width, int height,
                                               double least_step_counts);

}  // namespace thermedge::sim
