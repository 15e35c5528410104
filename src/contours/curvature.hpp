// Smoothing and curvature of sampled curves (paper section 3.2, eq. 9).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace thermedge::detail {

// Fills `kernel` with a sampled Gaussian of sum 1. Its half width is the last sample, of at most
// 30, where exp(-t^2 / 2 sigma^2) > 0.0001: 12 for sigma 3.
void gaussian_kernel(double sigma, std::vector<double>& kernel);

// Smooths `padded` into `smoothed`. `padded` has kernel.size() / 2 samples more at each end.
void smooth(std::span<const double> padded, std::span<const double> kernel,
            std::span<double> smoothed);

// K = |x' y'' - x'' y'| / (x'^2 + y'^2)^1.5 (eq. 9), rounded up to 0.01 1/px. The derivatives are
// central differences, one-sided at the ends, the second one taken of the first.
// NaN where the curve stands still. At least two samples.
void rounded_curvature(std::span<const double> x, std::span<const double> y,
                       std::span<double> curvature);

}  // namespace thermedge::detail
