#include "probe_model.hpp"

#include <algorithm>

#include "robust_pipeline.hpp"

namespace thermedge {

NoiseKind noise_kind(const NoiseSpectrum& spectrum) {
  constexpr std::size_t kFine = 5;  // periods of 16 / 5 px and less
  double sum = 0;
  int frequencies = 0;
  for (std::size_t v = 1; v < kNoiseBlockPx; ++v) {
    for (std::size_t u = 1; u < kNoiseBlockPx; ++u) {
      if (std::max(u, v) >= kFine) {
        sum += static_cast<double>(spectrum[v * kNoiseBlockPx + u]);
        ++frequencies;
      }
    }
  }
  const double fine = sum / frequencies;
  return fine < 0.35  ? NoiseKind::kSmooth
         : fine < 0.7 ? NoiseKind::kPartSmooth
         : fine < 1.5 ? NoiseKind::kWhite
                      : NoiseKind::kSharpened;
}

std::string_view noise_kind_meaning(NoiseKind kind) {
  switch (kind) {
    case NoiseKind::kNone:
      break;
    case NoiseKind::kWhite:
      return "neighbours have nothing in common, as on a raw sensor";
    case NoiseKind::kPartSmooth:
      return "a filter in the camera, or a pattern over few pixels";
    case NoiseKind::kSmooth:
      return "neighbours are alike: resampled, enlarged or blurred";
    case NoiseKind::kSharpened:
      return "strongest from pixel to pixel: an edge-enhancing filter";
  }
  return "too little to tell it from the rounding";
}

// An offset that a whole line of 8 pixels shares has sqrt(8) times its value as coefficient.
NoiseSpectrum RecordingReport::spectrum_with_stripes() const {
  NoiseSpectrum both = spectrum;
  if (sigma_counts > 0) {
    const auto added = [&](double stripes_counts) {
      const double share = stripes_counts / sigma_counts;
      return static_cast<float>(kNoiseBlockPx * share * share);
    };
    for (std::size_t i = 1; i < kNoiseBlockPx; ++i) {
      both[i] += added(column_sigma_counts);
      both[kNoiseBlockPx * i] += added(row_sigma_counts);
    }
  }
  return both;
}

namespace detail {
namespace {

constexpr int kTilePx = 24;  // about: the step between the nodes of the model's map

}  // namespace

double RecordingNoise::add(ImageView<const std::uint16_t> frame,
                           ImageView<const std::uint8_t> valid, double pixel_sigma_counts) {
  estimator_.measure(frame, valid, pixel_sigma_counts, model_);
  if (preset_ == Preset::kPaper) {
    model_.level_counts = pixel_sigma_counts;
  } else if (noisiness_of(model_.level_counts, pixel_sigma_counts) == 0) {
    model_.set_white(0);
  }
  const double square = model_.level_counts * model_.level_counts;
  sigma_.add(model_.level_counts);
  squares_ += square;
  for (std::size_t i = 0; i < variances_.size(); ++i) {
    variances_[i] += square * static_cast<double>(model_.spectrum[i]);
  }
  add_map(frame.width(), frame.height(), model_.level_counts);
  return model_.level_counts;
}

// The level in the middle of each tile.
void RecordingNoise::add_map(int width, int height, double sigma_counts) {
  tile_columns_ = std::max(width / kTilePx, 1);
  const int tile_rows = std::max(height / kTilePx, 1);
  tile_sums_.resize(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows));
  auto sum = tile_sums_.begin();
  for (int j = 0; j < tile_rows; ++j) {
    const int y = (2 * j + 1) * height / (2 * tile_rows);
    for (int i = 0; i < tile_columns_; ++i) {
      const int x = (2 * i + 1) * width / (2 * tile_columns_);
      *sum++ += sigma_counts * model_.map.at(x, y);
    }
  }
}

void RecordingNoise::report(RecordingReport& result) const {
  result.sigma_counts = sigma_.value();
  if (squares_ > 0) {
    std::transform(variances_.begin(), variances_.end(), result.spectrum.begin(),
                   [&](double variance) { return static_cast<float>(variance / squares_); });
    result.noise_kind = noise_kind(result.spectrum);
  }
  result.noise_map.columns = tile_columns_;
  result.noise_map.rows =
      tile_sums_.empty() ? 0 : static_cast<int>(tile_sums_.size()) / tile_columns_;
  result.noise_map.sigma_counts.clear();
  for (const double sum : tile_sums_) {
    result.noise_map.sigma_counts.push_back(sum / static_cast<double>(sigma_.count()));
  }
}

}  // namespace detail
}  // namespace thermedge
