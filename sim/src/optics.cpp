#include "optics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "portable_math.hpp"

namespace thermedge::sim {
namespace {

constexpr double kFirstDarkRing = 3.8317059702075125;  // zeros of J1
constexpr double kThirdDarkRing = 10.173468135062722;
constexpr int kTaskRows = 16;

// Bessel function of the first kind and order 1, by its series; for x up to some 15.
double bessel_j1(double x) {
  const double square = x * x / 4;
  double term = x / 2;
  double sum = term;
  for (int k = 1; k <= 50; ++k) {
    term *= -square / (k * (k + 1.0));
    sum += term;
  }
  return sum;
}

double airy(double distance, double first_dark_ring) {
  const double x = kFirstDarkRing * distance / first_dark_ring;
  if (x > kThirdDarkRing) {
    return 0;
  }
  const double amplitude = x == 0 ? 1 : 2 * bessel_j1(x) / x;
  return amplitude * amplitude;
}

void normalise(std::vector<double>& weights) {
  double sum = 0;
  for (const double weight : weights) {
    sum += weight;
  }
  for (double& weight : weights) {
    weight /= sum;
  }
}

// In sub-pixels; of odd length.
std::vector<double> gaussian(double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  std::vector<double> kernel;
  for (int i = -radius; i <= radius; ++i) {
    kernel.push_back(i == 0 ? 1.0 : detail::portable_exp(-i * i / (2 * sigma * sigma)));
  }
  normalise(kernel);
  return kernel;
}

std::vector<double> airy_disc(double first_dark_ring, int radius) {
  std::vector<double> kernel;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      kernel.push_back(airy(std::sqrt(static_cast<double>(x * x + y * y)), first_dark_ring));
    }
  }
  normalise(kernel);
  return kernel;
}

// Convolution of two square kernels, row by row.
std::vector<double> convolved(const std::vector<double>& a, int side_a,
                              const std::vector<double>& b, int side_b) {
  const int side = side_a + side_b - 1;
  std::vector<double> sum(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int i = 0; i < side_a * side_a; ++i) {
    for (int j = 0; j < side_b * side_b; ++j) {
      const int y = i / side_a + j / side_b;
      const int x = i % side_a + j % side_b;
      sum[static_cast<std::size_t>(y * side + x)] +=
          a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(j)];
    }
  }
  return sum;
}

std::vector<double> outer(const std::vector<double>& line) {
  std::vector<double> plane;
  for (const double a : line) {
    for (const double b : line) {
      plane.push_back(a * b);
    }
  }
  return plane;
}

// A Gaussian and the pixel's own width.
std::vector<double> with_aperture(const std::vector<double>& kernel) {
  std::vector<double> line(kernel.size() + kSubpixels - 1);
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    for (std::size_t k = 0; k < kSubpixels; ++k) {
      line[i + k] += kernel[i] / kSubpixels;
    }
  }
  return line;
}

}  // namespace

Optics::Optics(double blur_px, double airy_px) {
  const std::vector<double> line = with_aperture(gaussian(blur_px * kSubpixels));
  line_.assign(line.begin(), line.end());
  int side = static_cast<int>(line.size());
  if (airy_px > 0) {
    const double ring = airy_px * kSubpixels;
    const int radius = static_cast<int>(std::ceil(ring * kThirdDarkRing / kFirstDarkRing));
    const std::vector<double> plane =
        convolved(outer(line), side, airy_disc(ring, radius), 2 * radius + 1);
    plane_.assign(plane.begin(), plane.end());
    side += 2 * radius;
    plane_side_ = side;
  }
  margin_px_ = (side / 2 + kSubpixels - 1) / kSubpixels;
}

void Optics::run(ImageView<const float> fine, ImageView<float> pixels, ParallelRunner& runner) {
  if (plane_.empty()) {
    run_separable(fine, pixels, runner);
  } else {
    run_full(fine, pixels, runner);
  }
}

void Optics::run_separable(ImageView<const float> fine, ImageView<float> pixels,
                           ParallelRunner& runner) {
  const int taps = static_cast<int>(line_.size());
  // The first sub-pixel under the weights of pixel 0.
  const int first = (margin_px_ + 1) * kSubpixels - kSubpixels / 2 - taps / 2;
  const auto tasks = [](int rows) { return (rows + kTaskRows - 1) / kTaskRows; };
  rows_.resize(pixels.width(), fine.height());
  runner.run(tasks(fine.height()), [&](int task) {
    for (int y = task * kTaskRows; y < std::min((task + 1) * kTaskRows, fine.height()); ++y) {
      float* to = rows_.row(y);
      std::fill_n(to, pixels.width(), 0.0F);
      for (int k = 0; k < taps; ++k) {
        const float weight = line_[static_cast<std::size_t>(k)];
        const float* from = fine.row(y) + first + k;
        for (int x = 0; x < pixels.width(); ++x) {
          to[x] += weight * from[kSubpixels * x];
        }
      }
    }
  });
  runner.run(tasks(pixels.height()), [&](int task) {
    for (int y = task * kTaskRows; y < std::min((task + 1) * kTaskRows, pixels.height()); ++y) {
      float* to = pixels.row(y);
      std::fill_n(to, pixels.width(), 0.0F);
      for (int k = 0; k < taps; ++k) {
        const float weight = line_[static_cast<std::size_t>(k)];
        const float* from = rows_.row(kSubpixels * y + first + k);
        for (int x = 0; x < pixels.width(); ++x) {
          to[x] += weight * from[x];
        }
      }
    }
  });
}

void Optics::run_full(ImageView<const float> fine, ImageView<float> pixels,
                      ParallelRunner& runner) const {
  const int first = (margin_px_ + 1) * kSubpixels - kSubpixels / 2 - plane_side_ / 2;
  runner.run(pixels.height(), [&](int y) {
    float* to = pixels.row(y);
    std::fill_n(to, pixels.width(), 0.0F);
    for (int k = 0; k < plane_side_ * plane_side_; ++k) {
      const float weight = plane_[static_cast<std::size_t>(k)];
      const float* from =
          fine.row(kSubpixels * y + first + k / plane_side_) + first + k % plane_side_;
      for (int x = 0; x < pixels.width(); ++x) {
        to[x] += weight * from[kSubpixels * x];
      }
    }
  });
}

}  // namespace thermedge::sim
