// Noise whose neighbouring pixels depend on each other, as cameras and players hand it out.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "support/images.hpp"

namespace thermedge::test {

// value(x, y) of every pixel.
template <class F>
Image<double> picture(int width, int height, F&& value) {
  Image<double> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = value(x, y);
    }
  }
  return image;
}

// To the nearest count, clipped.
inline Image<std::uint16_t> rounded(ImageView<const double> values) {
  Image<std::uint16_t> frame(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y) {
    std::transform(values.row(y), values.row(y) + values.width(), frame.row(y), [](double value) {
      return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 65535.0)));
    });
  }
  return frame;
}

// White Gaussian noise around a mean, before it is smoothed as below.
struct WhiteNoise {
  double mean = 0;
  double sigma = 1;
  unsigned seed = 0;

  [[nodiscard]] Image<double> image(int width, int height) const {
    return noise_image<double>(width, height, mean, sigma, seed);
  }
};

// Means of 2 x 2 pixels: resampled half a pixel off to both sides.
inline Image<double> resampled(int width, int height, const WhiteNoise& white) {
  const auto noise = white.image(width + 1, height + 1);
  return picture(width, height, [&](int x, int y) {
    return (noise(x, y) + noise(x + 1, y) + noise(x, y + 1) + noise(x + 1, y + 1)) / 4;
  });
}

// Bilinear, pixels a quarter to either side of where they came from.
inline Image<double> enlarged_twice(int width, int height, const WhiteNoise& white) {
  const auto noise = white.image(width / 2 + 2, height / 2 + 2);
  return picture(width, height, [&](int x, int y) {
    const int i = (x + 1) / 2;
    const int j = (y + 1) / 2;
    const double a = x % 2 == 0 ? 0.75 : 0.25;
    const double b = y % 2 == 0 ? 0.75 : 0.25;
    return (1 - b) * ((1 - a) * noise(i, j) + a * noise(i + 1, j)) +
           b * ((1 - a) * noise(i, j + 1) + a * noise(i + 1, j + 1));
  });
}

// Smoothed by a Gaussian of 0.7 px.
inline Image<double> after_gaussian(int width, int height, const WhiteNoise& white) {
  constexpr double kSigmaPx = 0.7;
  constexpr int kReach = 4;
  const auto noise = white.image(width + 2 * kReach, height + 2 * kReach);
  std::array<double, 2 * kReach + 1> weights{};
  double sum = 0;
  for (int k = -kReach; k <= kReach; ++k) {
    sum += weights[static_cast<std::size_t>(k + kReach)] =
        std::exp(-0.5 * k * k / (kSigmaPx * kSigmaPx));
  }
  const auto mean = [&](auto&& value_at) {
    double total = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      total += weights[k] / sum * value_at(static_cast<int>(k));
    }
    return total;
  };
  const auto along_rows = picture(width, noise.height(), [&](int x, int y) {
    return mean([&](int k) { return noise(x + k, y); });
  });
  return picture(width, height,
                 [&](int x, int y) { return mean([&](int k) { return along_rows(x, y + k); }); });
}

}  // namespace thermedge::test
