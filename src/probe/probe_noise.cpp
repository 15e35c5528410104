#include "probe_noise.hpp"

#include <algorithm>
#include <cmath>

namespace thermedge::detail {
namespace {

constexpr double kSigmaOverMad = 1.4826;  // of a Gaussian
constexpr double kResidualGain = 6;       // of [1 -2 1] x [1 -2 1] for white noise
constexpr double kRoundingVariance = 1.0 / 12;
constexpr int kMostPatternFrames = 4096;  // bounds the sums; more would not sharpen the map
constexpr double kLargestResidual = 8.0 * 65535;

int second_difference(int first, int middle, int last) { return first - 2 * middle + last; }
int smoothed(int first, int middle, int last) { return first + 2 * middle + last; }

double squared(double value) { return value * value; }

double variance_of(std::vector<double>& magnitudes) {
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  return squared(kSigmaOverMad * *middle / kResidualGain);
}

}  // namespace

double sigma_of_magnitudes(std::vector<std::int32_t>& magnitudes) {
  if (magnitudes.empty()) {
    return 0;
  }
  const auto half = static_cast<double>(magnitudes.size()) / 2;
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>((magnitudes.size() - 1) / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  const std::int32_t value = *middle;
  if (value == 0) {
    return 0;
  }
  const auto below =
      std::count_if(magnitudes.begin(), middle, [&](std::int32_t v) { return v < value; });
  const auto equal = std::count(magnitudes.begin(), magnitudes.end(), value);
  return kSigmaOverMad *
         (value - 0.5 + (half - static_cast<double>(below)) / static_cast<double>(equal));
}

double TiledNoise::add(ImageView<const std::uint16_t> frame) {
  if (std::min(frame.width(), frame.height()) < tuning_.smallest_side_px) {
    return 0;
  }
  lay_tiles(frame.width() - 2, frame.height() - 2);
  previous_residual_.swap(residual_);
  previous_slope_.swap(slope_);
  previous_counts_.swap(counts_);
  filter(frame);
  double sum = 0;
  for (const Tile& tile : tiles_) {
    sum += tile_variance(tile, kResidualGain, [&](int x, int y) { return residual_(x, y); });
  }
  last_sigma_ = std::sqrt(sum / static_cast<double>(tiles_.size()));
  spatial_.add(last_sigma_);
  return last_sigma_;
}

void TiledNoise::lay_tiles(int width, int height) {
  if (!tiles_.empty()) {
    return;
  }
  const int tile_columns = std::max(width / tuning_.tile_side_px, 1);
  const int tile_rows = std::max(height / tuning_.tile_side_px, 1);
  for (int j = 0; j < tile_rows; ++j) {
    for (int i = 0; i < tile_columns; ++i) {
      const int x = i * width / tile_columns;
      const int y = j * height / tile_rows;
      tiles_.push_back(
          {x, y, (i + 1) * width / tile_columns - x, (j + 1) * height / tile_rows - y});
    }
  }
  for (Image<std::int32_t>& sums : pattern_sums_) {
    sums.resize(width, height);
    fill_pixels(sums.view(), 0);
  }
}

void TiledNoise::filter(ImageView<const std::uint16_t> frame) {
  residual_.resize(frame.width() - 2, frame.height() - 2);
  slope_.resize(frame.width() - 2, frame.height() - 2);
  counts_.resize(frame.width() - 2, frame.height() - 2);
  change_.resize(counts_.width(), counts_.height());  // not first when a frame changes
  change_slope_.resize(counts_.width(), counts_.height());
  for (int y = 0; y < residual_.height(); ++y) {
    const std::uint16_t* above = frame.row(y);
    const std::uint16_t* row = frame.row(y + 1);
    const std::uint16_t* under = frame.row(y + 2);
    for (int x = 0; x < residual_.width(); ++x) {
      const int left = second_difference(above[x], row[x], under[x]);
      const int centre = second_difference(above[x + 1], row[x + 1], under[x + 1]);
      const int right = second_difference(above[x + 2], row[x + 2], under[x + 2]);
      residual_(x, y) = second_difference(left, centre, right);
      const int gx =
          smoothed(above[x + 2] - above[x], row[x + 2] - row[x], under[x + 2] - under[x]);
      const int gy =
          smoothed(under[x] - above[x], under[x + 1] - above[x + 1], under[x + 2] - above[x + 2]);
      slope_(x, y) = std::abs(gx) + std::abs(gy);
      counts_(x, y) = row[x + 1];
    }
  }
}

// Of `value(x, y)` over the flatter half of a tile, in counts^2. Flatness does not bias it, because
// the slope of noise says nothing about its residual.
template <class F>
double TiledNoise::tile_variance(const Tile& tile, double gain, F&& value) {
  const auto slopes = slope_.view().crop(tile.x, tile.y, tile.width, tile.height);
  slopes_.clear();
  for (int y = 0; y < tile.height; ++y) {
    slopes_.insert(slopes_.end(), slopes.row(y), slopes.row(y) + tile.width);
  }
  const auto middle = slopes_.begin() + static_cast<std::ptrdiff_t>(slopes_.size() / 2);
  std::nth_element(slopes_.begin(), middle, slopes_.end());
  const std::int32_t largest_flat = *middle;
  magnitudes_.clear();
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      if (slopes(x, y) <= largest_flat) {
        magnitudes_.push_back(std::abs(value(tile.x + x, tile.y + y)));
      }
    }
  }
  return std::max(squared(sigma_of_magnitudes(magnitudes_) / gain) - kRoundingVariance, 0.0);
}

// The mixed second difference of the change at the lag, and the largest slope at its four corners
// in both frames.
void TiledNoise::fill_change() {
  const int width = counts_.width();
  const int height = counts_.height();
  const int lag = std::min({tuning_.change_lag_px, width / 2, height / 2});
  const auto change = [&](int x, int y) { return counts_(x, y) - previous_counts_(x, y); };
  const auto slope = [&](int x, int y) { return std::max(slope_(x, y), previous_slope_(x, y)); };
  for (int y = 0; y < height; ++y) {
    const int other_y = y + lag < height ? y + lag : y - lag;
    for (int x = 0; x < width; ++x) {
      const int other_x = x + lag < width ? x + lag : x - lag;
      change_(x, y) =
          change(x, y) - change(other_x, y) - change(x, other_y) + change(other_x, other_y);
      change_slope_(x, y) = std::max(std::max(slope(x, y), slope(other_x, y)),
                                     std::max(slope(x, other_y), slope(other_x, other_y)));
    }
  }
}

void TiledNoise::add_change() {
  if (previous_residual_.empty()) {
    return;
  }
  fill_change();
  for (int y = 0; y < slope_.height(); ++y) {
    std::transform(slope_.row(y), slope_.row(y) + slope_.width(), previous_slope_.row(y),
                   previous_slope_.row(y),
                   [](std::int32_t now, std::int32_t before) { return std::max(now, before); });
  }
  slope_.swap(previous_slope_);  // flat is what is flat in both
  double sum = 0;
  for (Tile& tile : tiles_) {
    const double variance = tile_variance(tile, kResidualGain * std::sqrt(2.0), [&](int x, int y) {
      return residual_(x, y) - previous_residual_(x, y);
    });
    tile.residual_variances += variance;
    sum += variance;
  }
  slope_.swap(previous_slope_);
  slope_.swap(change_slope_);
  for (Tile& tile : tiles_) {
    tile.change_variances += tile_variance(tile, 2 * std::sqrt(2.0),  // of 4 pixels in 2 frames
                                           [&](int x, int y) { return change_(x, y); });
  }
  slope_.swap(change_slope_);
  temporal_.add(std::sqrt(sum / static_cast<double>(tiles_.size())));
}

// The variance of a pixel in units of that of the residual, both with the rounding in them. What
// moves adds to the former, and most where there is most of it: the quieter quarter tells.
double TiledNoise::likeness_of_neighbours() const {
  const auto frames = static_cast<double>(temporal_.count());
  std::vector<double> ratios;
  for (const Tile& tile : tiles_) {
    ratios.push_back((tile.change_variances / frames + kRoundingVariance) /
                     (tile.residual_variances / frames + kRoundingVariance));
  }
  const auto quarter = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 4);
  std::nth_element(ratios.begin(), quarter, ratios.end());
  return std::max(*quarter, 1.0);
}

void TiledNoise::add_to_pattern() {
  const int frames = pattern_frames_[0] + pattern_frames_[1];
  if (residual_.empty() || frames >= kMostPatternFrames) {
    return;
  }
  const auto part = static_cast<std::size_t>(frames % 2);
  ++pattern_frames_[part];
  // Sums stay below 2^31 / 2: a residual of more says nothing about noise.
  const double clip =
      std::min(tuning_.pattern_clip_sigmas * kResidualGain * last_sigma_, kLargestResidual);
  const auto limit = static_cast<std::int32_t>(clip);
  for (int y = 0; y < residual_.height(); ++y) {
    const std::int32_t* from = residual_.row(y);
    std::int32_t* sums = pattern_sums_[part].row(y);
    for (int x = 0; x < residual_.width(); ++x) {
      sums[x] += std::clamp(from[x], -limit, limit);
    }
  }
}

std::optional<double> TiledNoise::temporal_sigma_counts() const {
  if (temporal_.count() == 0) {
    return std::nullopt;
  }
  const double of_residual = squared(temporal_.value()) + kRoundingVariance;
  return std::sqrt(std::max(likeness_of_neighbours() * of_residual - kRoundingVariance, 0.0));
}

std::optional<TiledNoise::Pattern> TiledNoise::pattern() const {
  if (pattern_frames_[0] + pattern_frames_[1] < tuning_.least_pattern_frames) {
    return std::nullopt;
  }
  std::vector<double> sums, differences;
  double variance = 0;
  for (const Tile& tile : tiles_) {
    sums.clear();
    differences.clear();
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        const double a = pattern_sums_[0](x, y) / static_cast<double>(pattern_frames_[0]);
        const double b = pattern_sums_[1](x, y) / static_cast<double>(pattern_frames_[1]);
        sums.push_back(std::abs(a + b));
        differences.push_back(std::abs(a - b));
      }
    }
    variance += (variance_of(sums) - variance_of(differences)) / 4;
  }
  variance = std::max(variance / static_cast<double>(tiles_.size()), 0.0);
  const double spatial = squared(sigma_counts());
  return Pattern{std::sqrt(variance), spatial > 0 ? std::min(variance / spatial, 1.0) : 0.0};
}

}  // namespace thermedge::detail
