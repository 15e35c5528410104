#include "thermedge/stages/canny.hpp"

#include <algorithm>
#include <cmath>

#include "gradient_simd.hpp"
#include "hysteresis.hpp"
#include "suppression_simd.hpp"

namespace thermedge {
namespace {

constexpr int kBandRows = 32;

// Adds the magnitudes of a row to a histogram from 0 to the largest one; `bins_per_unit` is the
// number of bins over the largest magnitude. Four tables, because equal neighbours would wait for
// each other's increments.
template <std::size_t kBins>
void count_row(const float* magnitude, int width, double bins_per_unit,
               std::array<std::array<std::uint32_t, kBins>, 4>& tables) {
  constexpr int kLastBin = static_cast<int>(kBins) - 1;
  for (int x = 0; x < width; ++x) {
    const int bin = static_cast<int>(static_cast<double>(magnitude[x]) * bins_per_unit);
    ++tables[static_cast<std::size_t>(x % 4)][static_cast<std::size_t>(std::min(bin, kLastBin))];
  }
}

DenoiseOptions gaussian_of_eq5() {
  DenoiseOptions options;
  options.method = DenoiseMethod::kGaussian;
  options.gaussian.sigma_px = 0;
  return options;
}

}  // namespace

Status CannyOptions::check() const { return check_ranges(*this, "canny."); }

Canny::Canny(const CannyOptions& options) : options_(options), blur_(gaussian_of_eq5()) {}

Result<CannyResult> Canny::run(ImageView<const float> in, ParallelRunner& runner) {
  if (in.empty()) {
    return failure(ErrorCode::kInvalidArgument, "frame: it has no pixels");
  }
  if (Status status = options_.check(); !status) {
    return tl::unexpected(status.error());
  }
  if (options_.blur) {
    blurred_.resize(in.width(), in.height());
    if (Status status = blur_.run(in, 0, blurred_, runner); !status) {
      return tl::unexpected(status.error());
    }
    in = blurred_;
  }
  prepare(in.width(), in.height());
  for_each_band(runner, [&](Band&, int begin, int end) { add_border(in, begin, end); });
  for_each_band(runner, [&](Band& band, int begin, int end) {
    band.largest_magnitude = find_gradients(begin, end);
  });
  const float largest = std::max_element(bands_.begin(), bands_.end(), [](auto& a, auto& b) {
                          return a.largest_magnitude < b.largest_magnitude;
                        })->largest_magnitude;
  if (!std::isfinite(largest)) {
    return failure(ErrorCode::kInvalidArgument,
                   "frame: a pixel is NaN, infinite or beyond 1e18; all must be finite");
  }
  const Thresholds thresholds = choose_thresholds(largest, runner);
  for_each_band(runner, [&](Band&, int begin, int end) { suppress(begin, end, thresholds); });
  detail::apply_hysteresis(edges_.view(), 1, group_);
  return CannyResult{gx_, gy_, magnitude_, edges_, thresholds.low, thresholds.high};
}

void Canny::prepare(int width, int height) {
  bordered_.resize(width + 2, height + 2);
  gx_.resize(width, height);
  gy_.resize(width, height);
  magnitude_.resize(width, height);
  edges_.resize(width, height);
  bands_.resize(static_cast<std::size_t>((height + kBandRows - 1) / kBandRows));
  group_.reserve(edges_.size());
}

// task(band, y_begin, y_end): the bands depend on the height alone, not on the ParallelRunner.
template <class F>
void Canny::for_each_band(ParallelRunner& runner, F&& task) {
  runner.run(static_cast<int>(bands_.size()), [&](int index) {
    const int y_begin = index * kBandRows;
    const int y_end = std::min(y_begin + kBandRows, edges_.height());
    task(bands_[static_cast<std::size_t>(index)], y_begin, y_end);
  });
}

// Rows of the input with their first and last pixel repeated; the first and last row twice.
void Canny::add_border(ImageView<const float> in, int y_begin, int y_end) {
  const int width = in.width();
  const auto copy_row = [&](int y, int bordered_y) {
    float* row = bordered_.row(bordered_y);
    row[0] = in(0, y);
    std::copy_n(in.row(y), width, row + 1);
    row[width + 1] = in(width - 1, y);
  };
  for (int y = y_begin; y < y_end; ++y) {
    copy_row(y, y + 1);
  }
  if (y_begin == 0) {
    copy_row(0, 0);
  }
  if (y_end == in.height()) {
    copy_row(y_end - 1, y_end + 1);
  }
}

// Returns the largest magnitude.
float Canny::find_gradients(int y_begin, int y_end) {
  float largest = 0;
  for (int y = y_begin; y < y_end; ++y) {
    const detail::BorderedRows rows{bordered_.row(y), bordered_.row(y + 1), bordered_.row(y + 2)};
    largest = std::max(
        largest, detail::sobel_row(rows, gx_.width(), gx_.row(y), gy_.row(y), magnitude_.row(y)));
  }
  return largest;
}

Canny::Thresholds Canny::choose_thresholds(float largest_magnitude, ParallelRunner& runner) {
  const auto with_high = [&](double high) {
    return Thresholds{static_cast<float>(options_.low_over_high * high), static_cast<float>(high)};
  };
  if (options_.high_threshold > 0 || largest_magnitude == 0) {
    return with_high(options_.high_threshold);
  }
  const double bins_per_unit = kBins / static_cast<double>(largest_magnitude);
  for_each_band(runner, [&](Band& band, int y_begin, int y_end) {
    std::array<decltype(Band::histogram), 4> tables{};
    for (int y = y_begin; y < y_end; ++y) {
      count_row(magnitude_.row(y), magnitude_.width(), bins_per_unit, tables);
    }
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      band.histogram[bin] = tables[0][bin] + tables[1][bin] + tables[2][bin] + tables[3][bin];
    }
  });
  const double non_edges = options_.non_edge_share * static_cast<double>(magnitude_.size());
  double below = 0;
  std::size_t bins = 0;
  while (bins < kBins && below <= non_edges) {
    for (const Band& band : bands_) {
      below += band.histogram[bins];
    }
    ++bins;
  }
  return with_high(static_cast<double>(bins) / bins_per_unit);
}

// Leaves in edges_ the class of each pixel before hysteresis.
void Canny::suppress(int y_begin, int y_end, Thresholds thresholds) {
  const int width = edges_.width();
  const int height = edges_.height();
  for (int y = y_begin; y < y_end; ++y) {
    std::uint8_t* classes = edges_.row(y);
    if (y == 0 || y == height - 1 || width < 3) {
      std::fill_n(classes, width, detail::kNoEdge);
      continue;
    }
    const detail::GradientRow row{gx_.row(y) + 1, gy_.row(y) + 1, magnitude_.row(y) + 1,
                                  magnitude_.stride()};
    detail::suppress_row(row, width - 2, thresholds.low, thresholds.high, classes + 1);
    classes[0] = detail::kNoEdge;
    classes[width - 1] = detail::kNoEdge;
  }
}

}  // namespace thermedge
