#include "processing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "portable.hpp"
#include "sensor.hpp"

namespace thermedge::bench {
namespace {

// The value of each pixel from its place.
template <class F>
Image<float> picture(int width, int height, F&& value) {
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = static_cast<float>(value(x, y));
    }
  }
  return image;
}

float pixel(ImageView<const float> image, int x, int y) {
  return image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1));
}

// Linear interpolation.
double between(ImageView<const float> image, double x, double y) {
  const auto left = static_cast<int>(std::floor(x));
  const auto top = static_cast<int>(std::floor(y));
  const double right_share = x - left;
  const double bottom_share = y - top;
  const auto row = [&](int v) {
    return (1 - right_share) * pixel(image, left, v) + right_share * pixel(image, left + 1, v);
  };
  return (1 - bottom_share) * row(top) + bottom_share * row(top + 1);
}

constexpr int kBlock = 8;  // pixels on a side of JPEG's blocks
using Block = std::array<std::array<double, kBlock>, kBlock>;

// Steps of the coefficients of brightness at quality 50; rows are frequencies in y.
constexpr std::array<std::array<int, kBlock>, kBlock> kJpegSteps = {
    {{16, 11, 10, 16, 24, 40, 51, 61},
     {12, 12, 14, 19, 26, 58, 60, 55},
     {14, 13, 16, 24, 40, 57, 69, 56},
     {14, 17, 22, 29, 51, 87, 80, 62},
     {18, 22, 37, 56, 68, 109, 103, 77},
     {24, 35, 55, 64, 81, 104, 113, 92},
     {49, 64, 78, 87, 103, 121, 120, 101},
     {72, 92, 95, 98, 112, 100, 103, 99}}};

int jpeg_step(int quality, int v, int u) {
  const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  const int base = kJpegSteps[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
  return std::clamp((base * scale + 50) / 100, 1, 255);
}

// Orthonormal: the rows are the cosines.
Block cosines() {
  Block rows{};
  for (int k = 0; k < kBlock; ++k) {
    const double height = k == 0 ? std::sqrt(1.0 / kBlock) : std::sqrt(2.0 / kBlock);
    for (int i = 0; i < kBlock; ++i) {
      rows[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] =
          height * sim::sin_cos(std::numbers::pi * (2 * i + 1) * k / (2 * kBlock)).cos;
    }
  }
  return rows;
}

Block product(const Block& a, const Block& b) {
  Block result{};
  for (std::size_t i = 0; i < kBlock; ++i) {
    for (std::size_t k = 0; k < kBlock; ++k) {
      for (std::size_t j = 0; j < kBlock; ++j) {
        result[i][j] += a[i][k] * b[k][j];
      }
    }
  }
  return result;
}

Block transposed(const Block& a) {
  Block result{};
  for (std::size_t i = 0; i < kBlock; ++i) {
    for (std::size_t j = 0; j < kBlock; ++j) {
      result[i][j] = a[j][i];
    }
  }
  return result;
}

}  // namespace

Image<float> moved_by_half(ImageView<const float> image) {
  return picture(image.width(), image.height(),
                 [&](int x, int y) { return between(image, x + 0.5, y + 0.5); });
}

Image<float> turned(ImageView<const float> image, double angle_rad) {
  const auto [sine, cosine] = sim::sin_cos(angle_rad);
  const double middle_x = (image.width() - 1) / 2.0;
  const double middle_y = (image.height() - 1) / 2.0;
  return picture(image.width(), image.height(), [&, sine = sine, cosine = cosine](int x, int y) {
    const double dx = x - middle_x;
    const double dy = y - middle_y;
    return between(image, middle_x + cosine * dx - sine * dy, middle_y + sine * dx + cosine * dy);
  });
}

Image<float> enlarged(ImageView<const float> image) {
  return picture(2 * image.width(), 2 * image.height(), [&](int x, int y) {
    return between(image, (x + 0.5) / 2 - 0.5, (y + 0.5) / 2 - 0.5);
  });
}

Image<float> repeated(ImageView<const float> image) {
  return picture(2 * image.width(), 2 * image.height(),
                 [&](int x, int y) { return image(x / 2, y / 2); });
}

Image<float> median_of_9(ImageView<const float> image) {
  return picture(image.width(), image.height(), [&](int x, int y) {
    std::array<float, 9> around{};
    std::size_t count = 0;
    for (int v = y - 1; v <= y + 1; ++v) {
      for (int u = x - 1; u <= x + 1; ++u) {
        around[count++] = pixel(image, u, v);
      }
    }
    std::nth_element(around.begin(), around.begin() + 4, around.end());
    return around[4];
  });
}

Image<float> blurred(ImageView<const float> image, double sigma_px) {
  const auto radius = static_cast<int>(std::ceil(4 * sigma_px));
  std::vector<double> weights;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += weights.back();
  }
  const auto weighted = [&](auto&& value_at) {
    double total = 0;
    for (int i = -radius; i <= radius; ++i) {
      total += weights[static_cast<std::size_t>(i + radius)] * value_at(i);
    }
    return total / sum;
  };
  const Image<float> along_rows = picture(image.width(), image.height(), [&](int x, int y) {
    return weighted([&](int i) { return pixel(image, x + i, y); });
  });
  return picture(image.width(), image.height(), [&](int x, int y) {
    return weighted([&](int i) { return pixel(along_rows, x, y + i); });
  });
}

Image<float> in_steps(ImageView<const float> image, double step) {
  return picture(image.width(), image.height(),
                 [&](int x, int y) { return step * std::round(image(x, y) / step); });
}

Image<float> through_jpeg(ImageView<const float> levels, int quality) {
  constexpr double kMiddleLevel = 128;
  static constexpr double kMostLevel = 255;
  const auto level = [](double value) { return std::clamp(std::round(value), 0.0, kMostLevel); };
  const Block forward = cosines();
  const Block back = transposed(forward);
  Image<float> result(levels.width(), levels.height());
  for (int top = 0; top < levels.height(); top += kBlock) {
    for (int left = 0; left < levels.width(); left += kBlock) {
      Block block{};
      for (int v = 0; v < kBlock; ++v) {
        for (int u = 0; u < kBlock; ++u) {
          block[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)] =
              level(pixel(levels, left + u, top + v)) - kMiddleLevel;
        }
      }
      Block coefficients = product(product(forward, block), back);
      for (int v = 0; v < kBlock; ++v) {
        for (int u = 0; u < kBlock; ++u) {
          double& c = coefficients[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
          const double step = jpeg_step(quality, v, u);
          c = step * std::round(c / step);
        }
      }
      block = product(product(back, coefficients), forward);
      for (int y = top; y < std::min(top + kBlock, levels.height()); ++y) {
        for (int x = left; x < std::min(left + kBlock, levels.width()); ++x) {
          result(x, y) = static_cast<float>(
              level(block[static_cast<std::size_t>(y - top)][static_cast<std::size_t>(x - left)] +
                    kMiddleLevel));
        }
      }
    }
  }
  return result;
}

Image<std::uint16_t> without_outliers(ImageView<const std::uint16_t> counts, double sigma_counts) {
  const Image<float> image = as_float(counts);
  const Image<float> medians = median_of_9(image);
  return rounded(picture(counts.width(), counts.height(), [&](int x, int y) {
    const bool outlier = std::abs(image(x, y) - medians(x, y)) > 6 * sigma_counts;
    return outlier ? medians(x, y) : image(x, y);
  }));
}

Image<float> as_float(ImageView<const std::uint16_t> counts) {
  return picture(counts.width(), counts.height(), [&](int x, int y) { return counts(x, y); });
}

Image<std::uint16_t> rounded(ImageView<const float> image) {
  Image<std::uint16_t> counts(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      counts(x, y) = static_cast<std::uint16_t>(
          std::clamp(std::round(image(x, y)), 0.0F, static_cast<float>(sim::kLargestCount)));
    }
  }
  return counts;
}

}  // namespace thermedge::bench
