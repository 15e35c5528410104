#include "thermedge/stages/classical.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

namespace thermedge {
namespace {

constexpr double kLargestLevel = 1e9;

tl::unexpected<Error> wrong(std::string message) {
  return failure(ErrorCode::kInvalidArgument, std::move(message));
}

Status check_frame(ImageView<const float> levels, ImageView<std::uint8_t> edges) {
  if (levels.empty() || !same_size(levels, edges)) {
    return wrong("classical: the frame is empty or the edge map has another size");
  }
  for (int y = 0; y < levels.height(); ++y) {
    if (!std::all_of(levels.row(y), levels.row(y) + levels.width(),
                     [](float level) { return std::abs(level) <= kLargestLevel; })) {
      return wrong("classical: a pixel is NaN, infinite or beyond 1e9");
    }
  }
  return {};
}

DenoiseOptions smoothing(double sigma_px) {
  DenoiseOptions options;
  options.method = sigma_px > 0 ? DenoiseMethod::kGaussian : DenoiseMethod::kNone;
  options.gaussian.sigma_px = sigma_px;
  return options;
}

template <class F>
double mean_of(ImageView<const double> image, F&& value) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    const double* row = image.row(y);
    for (int x = 0; x < image.width(); ++x) {
      sum += value(row[x]);
    }
  }
  return sum / static_cast<double>(image.size());
}

// Squared gradient of one pixel, times the square of the kernels' sum of absolute weights. The rows
// above, at and below the pixel are given from one pixel left of it.
struct PrewittSquare {
  static constexpr double kGain = 6;
  static constexpr double kThresholdFactor = 4;
  static double at(const double* above, const double* here, const double* below) {
    const double gx = (above[2] - above[0]) + (here[2] - here[0]) + (below[2] - below[0]);
    const double gy = (below[0] - above[0]) + (below[1] - above[1]) + (below[2] - above[2]);
    return gx * gx + gy * gy;
  }
};

struct SobelSquare {
  static constexpr double kGain = 8;
  static constexpr double kThresholdFactor = 4;
  static double at(const double* above, const double* here, const double* below) {
    const double gx = (above[2] - above[0]) + 2 * (here[2] - here[0]) + (below[2] - below[0]);
    const double gy = (below[0] - above[0]) + 2 * (below[1] - above[1]) + (below[2] - above[2]);
    return gx * gx + gy * gy;
  }
};

// Differences along both diagonals of the square right of and below the pixel.
struct RobertsSquare {
  static constexpr double kGain = 2;
  static constexpr double kThresholdFactor = 6;
  static double at(const double*, const double* here, const double* below) {
    const double falling = here[1] - below[2];
    const double rising = here[2] - below[1];
    return falling * falling + rising * rising;
  }
};

// `squares` without its margin is filled; returns the square of the threshold.
template <class Square>
double square_gradients(ImageView<const double> bordered, double threshold,
                        ImageView<double> squares) {
  for (int y = 0; y < squares.height(); ++y) {
    const double* above = bordered.row(y);
    const double* here = bordered.row(y + 1);
    const double* below = bordered.row(y + 2);
    double* out = squares.row(y);
    for (int x = 0; x < squares.width(); ++x) {
      out[x] = Square::at(above + x, here + x, below + x);
    }
  }
  if (threshold > 0) {
    return threshold * threshold * Square::kGain * Square::kGain;
  }
  return Square::kThresholdFactor * mean_of(squares, [](double square) { return square; });
}

}  // namespace

Status check_options(const ClassicalOptions& options) {
  if (!(options.threshold >= 0) || !std::isfinite(options.threshold)) {
    return wrong("classical.threshold: should be finite and >= 0");
  }
  if (!(options.log_sigma_px >= 0.5 && options.log_sigma_px <= 10)) {
    return wrong("classical.log_sigma_px: should be 0.5 to 10");
  }
  const double smoothing = options.canny_sigma_px;
  if (smoothing != 0 && !(smoothing >= 0.3 && smoothing <= 20)) {
    return wrong("classical.canny_sigma_px: should be 0 or 0.3 to 20");
  }
  const int side = options.log_kernel_px;
  if (side != 0 && (side < 3 || side > 61 || side % 2 == 0)) {
    return wrong("classical.log_kernel_px: should be 0 or an odd number from 3 to 61");
  }
  return {};
}

ClassicalDetector::ClassicalDetector(const ClassicalOptions& options)
    : options_(options), smoother_(smoothing(options.canny_sigma_px)), canny_(options.canny) {}

Status ClassicalDetector::run(ImageView<const float> levels, ClassicalMethod method,
                              ImageView<std::uint8_t> edges, ParallelRunner& runner) {
  Status status = check_options(options_).and_then([&] { return check_frame(levels, edges); });
  if (!status) {
    return status;
  }
  switch (method) {
    case ClassicalMethod::kPrewitt:
    case ClassicalMethod::kRoberts:
    case ClassicalMethod::kSobel:
      add_border(levels, 1, false);
      detect_by_gradient(method, edges);
      return {};
    case ClassicalMethod::kLog: {
      const int side = options_.log_kernel_px != 0
                           ? options_.log_kernel_px
                           : 2 * static_cast<int>(std::ceil(3 * options_.log_sigma_px)) + 1;
      add_border(levels, side / 2, options_.log_as_octave);
      detect_by_log(edges);
      return {};
    }
    case ClassicalMethod::kCanny:
      break;
  }
  return detect_by_canny(levels, edges, runner);
}

void ClassicalDetector::add_border(ImageView<const float> levels, int margin, bool zeros) {
  const int width = levels.width();
  const int height = levels.height();
  bordered_.resize(width + 2 * margin, height + 2 * margin);
  for (int y = 0; y < bordered_.height(); ++y) {
    const float* from = levels.row(std::clamp(y - margin, 0, height - 1));
    const bool outside = y < margin || y >= margin + height;
    double* to = bordered_.row(y);
    if (zeros && outside) {
      std::fill_n(to, bordered_.width(), 0.0);
      continue;
    }
    std::fill_n(to, margin, zeros ? 0.0 : double{from[0]});
    std::copy_n(from, width, to + margin);
    std::fill_n(to + margin + width, margin, zeros ? 0.0 : double{from[width - 1]});
  }
}

void ClassicalDetector::detect_by_gradient(ClassicalMethod method, ImageView<std::uint8_t> edges) {
  const int width = edges.width();
  const int height = edges.height();
  response_.resize(width + 2, height + 2);
  fill_pixels(response_.view(), 0.0);
  const ImageView<double> squares = response_.view().crop(1, 1, width, height);
  const double threshold =
      method == ClassicalMethod::kPrewitt
          ? square_gradients<PrewittSquare>(bordered_, options_.threshold, squares)
      : method == ClassicalMethod::kSobel
          ? square_gradients<SobelSquare>(bordered_, options_.threshold, squares)
          : square_gradients<RobertsSquare>(bordered_, options_.threshold, squares);
  for (int y = 0; y < height; ++y) {
    double* row = squares.row(y);
    std::transform(row, row + width, row,
                   [=](double square) { return square > threshold ? square : 0.0; });
  }
  const std::ptrdiff_t stride = squares.stride();
  for (int y = 0; y < height; ++y) {
    const double* row = squares.row(y);
    std::uint8_t* out = edges.row(y);
    for (int x = 0; x < width; ++x) {
      const double* at = row + x;
      const bool kept = options_.thinning ? (*at > at[-1] && *at > at[1]) ||
                                                (*at > at[-stride] && *at > at[stride])
                                          : *at > 0;
      out[x] = kept ? 255 : 0;
    }
  }
}

// response_ += bordered_ filtered with the product of the two kernels.
void ClassicalDetector::filter_separably(const std::vector<double>& along_rows,
                                         const std::vector<double>& along_columns) {
  const int width = response_.width();
  rows_.resize(width, bordered_.height());
  for (int y = 0; y < bordered_.height(); ++y) {
    const double* from = bordered_.row(y);
    double* to = rows_.row(y);
    std::fill_n(to, width, 0.0);
    for (std::size_t tap = 0; tap < along_rows.size(); ++tap) {
      const double weight = along_rows[tap];
      for (int x = 0; x < width; ++x) {
        to[x] += weight * from[static_cast<std::size_t>(x) + tap];
      }
    }
  }
  for (int y = 0; y < response_.height(); ++y) {
    double* to = response_.row(y);
    for (std::size_t tap = 0; tap < along_columns.size(); ++tap) {
      const double weight = along_columns[tap];
      const double* from = rows_.row(y + static_cast<int>(tap));
      for (int x = 0; x < width; ++x) {
        to[x] += weight * from[x];
      }
    }
  }
}

// LoG(x, y) = (x^2 + y^2 - 2 s^2) / s^4 g(x) g(y): the sum of two separable kernels; less its mean,
// which is a third one.
void ClassicalDetector::prepare_log_kernels(int radius) {
  const double variance = options_.log_sigma_px * options_.log_sigma_px;
  const auto side = static_cast<std::size_t>(2 * radius + 1);
  gauss_.resize(side);
  second_.resize(side);
  for (int i = -radius; i <= radius; ++i) {
    gauss_[static_cast<std::size_t>(i + radius)] = std::exp(-i * i / (2 * variance));
  }
  const double sum = std::accumulate(gauss_.begin(), gauss_.end(), 0.0);
  for (int i = -radius; i <= radius; ++i) {
    const auto at = static_cast<std::size_t>(i + radius);
    gauss_[at] /= sum;
    second_[at] = (i * i - variance) / (variance * variance) * gauss_[at];
  }
  const double mean = 2 * std::accumulate(second_.begin(), second_.end(), 0.0) /
                      (static_cast<double>(side) * static_cast<double>(side));
  ones_.assign(side, 1.0);
  minus_mean_.assign(side, -mean);
}

void ClassicalDetector::detect_by_log(ImageView<std::uint8_t> edges) {
  const int width = edges.width();
  const int height = edges.height();
  prepare_log_kernels((bordered_.width() - width) / 2);
  response_.resize(width, height);
  fill_pixels(response_.view(), 0.0);
  filter_separably(second_, gauss_);
  filter_separably(gauss_, second_);
  if (!options_.log_as_octave) {
    filter_separably(ones_, minus_mean_);
  }
  const double threshold =
      options_.threshold > 0
          ? options_.threshold
          : 0.75 * mean_of(response_.view(), [](double value) { return std::abs(value); });
  const auto negative = [&](int x, int y) {
    return response_.view().contains(x, y) && response_(x, y) < 0;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value = response_(x, y);
      const bool edge = value > threshold && (negative(x - 1, y) || negative(x + 1, y) ||
                                              negative(x, y - 1) || negative(x, y + 1));
      edges(x, y) = edge ? 255 : 0;
    }
  }
}

Status ClassicalDetector::detect_by_canny(ImageView<const float> levels,
                                          ImageView<std::uint8_t> edges, ParallelRunner& runner) {
  smoothed_.resize(levels.width(), levels.height());
  return smoother_.run(levels, 0, smoothed_, runner)
      .and_then([&] { return canny_.run(smoothed_, runner); })
      .map([&](const CannyResult& found) { copy_pixels(found.edges, edges); });
}

}  // namespace thermedge
