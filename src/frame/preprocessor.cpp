#include "thermedge/stages/preprocessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "order_statistics.hpp"

namespace thermedge {
namespace {

constexpr double kMostCounts = std::numeric_limits<std::uint16_t>::max();

bool is_count(float value) {
  return value >= 0 && value <= static_cast<float>(kMostCounts) && std::floor(value) == value;
}

}  // namespace

ImageView<const std::uint16_t> Preprocessor::run(const Frame& frame, ParallelRunner& runner,
                                                 Corrections& corrections) {
  corrected_.resize(frame.width(), frame.height());
  valid_.resize(frame.width(), frame.height());
  hole_filler_.prepare(frame.width(), frame.height());
  invalid_finder_.prepare(frame.width(), frame.height());
  load(frame, corrections);
  note_validity(frame, corrections.invalid);
  fill_invalid(corrections.invalid);
  measure_noise(runner, corrections);
  corrections.bad_pixels.clear();
  corrections.stripes.columns.clear();
  corrections.stripes.rows.clear();
  const double sigma_counts = corrections.noise_model.level_counts;
  if (bad_pixel_options_.replace) {
    replace_bad_pixels(corrected_, sigma_counts, bad_pixel_options_, corrections.bad_pixels);
  }
  if (stripe_options_.remove) {
    stripe_finder_.measure(corrected_, sigma_counts, runner, corrections.stripes);
    remove_stripes(corrections.stripes, corrected_);
  }
  return corrected_;
}

// That of the pixels and its model, side by side.
void Preprocessor::measure_noise(ParallelRunner& runner, Corrections& corrections) {
  bool is_found = false;
  runner.run(model_noise_ ? 2 : 1, [&](int task) {
    if (task == 0) {
      corrections.noise = noise_estimator_.measure(corrected_);
    } else {
      is_found = model_estimator_.find(corrected_, valid_view_, corrections.noise_model);
    }
  });
  if (!is_found) {
    corrections.noise_model.set_white(corrections.noise.sigma_counts);
  }
}

void Preprocessor::load(const Frame& frame, Corrections& corrections) {
  corrections.counts_per_unit = 1;
  corrections.offset = 0;
  if (const auto* levels = std::get_if<ImageView<const std::uint8_t>>(&frame.pixels)) {
    copy_pixels(*levels, corrected_.view());
  } else if (const auto* counts = std::get_if<ImageView<const std::uint16_t>>(&frame.pixels)) {
    copy_pixels(*counts, corrected_.view());
  } else if (const auto* values = std::get_if<ImageView<const float>>(&frame.pixels)) {
    load_values(*values, corrections);
  }
}

// Pixels that are not finite are filled afterwards.
void Preprocessor::load_values(ImageView<const float> values, Corrections& corrections) {
  bool are_counts = true;
  for (int y = 0; y < values.height() && are_counts; ++y) {
    are_counts = std::all_of(values.row(y), values.row(y) + values.width(),
                             [](float value) { return is_count(value) || !std::isfinite(value); });
  }
  if (!are_counts) {
    choose_scale(values, corrections);
  }
  for (int y = 0; y < values.height(); ++y) {
    std::transform(
        values.row(y), values.row(y) + values.width(), corrected_.row(y), [&](float value) {
          const double count =
              (static_cast<double>(value) - corrections.offset) * corrections.counts_per_unit;
          return std::isfinite(value)
                     ? static_cast<std::uint16_t>(std::clamp(count, 0.0, kMostCounts) + 0.5)
                     : std::uint16_t{0};
        });
  }
}

// A power of two, so that no precision is lost and frames of a sequence keep the same scale.
void Preprocessor::choose_scale(ImageView<const float> values, Corrections& corrections) {
  constexpr double kTail = 0.001;
  constexpr double kSpanCounts = 16384;
  constexpr double kMiddleCounts = 32768;
  sample_.clear();
  sample_.reserve(values.size());
  for (int y = 0; y < values.height(); ++y) {
    std::copy_if(values.row(y), values.row(y) + values.width(), std::back_inserter(sample_),
                 [](float value) { return std::isfinite(value); });
  }
  if (sample_.empty()) {
    return;
  }
  const auto quantile = [&](double share) {
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(sample_.size() - 1));
    return static_cast<double>(detail::nth_value(std::span(sample_), rank));
  };
  const double low = quantile(kTail);
  const double high = quantile(1 - kTail);
  const double span = high > low ? high - low : 1;
  corrections.counts_per_unit = std::exp2(std::floor(std::log2(kSpanCounts / span)));
  corrections.offset = (low + high) / 2 - kMiddleCounts / corrections.counts_per_unit;
}

void Preprocessor::note_validity(const Frame& frame, InvalidPixels& invalid) {
  const auto* values = std::get_if<ImageView<const float>>(&frame.pixels);
  invalid = {};
  for (int y = 0; y < frame.height(); ++y) {
    std::uint8_t* valid = valid_.row(y);
    if (frame.valid.empty()) {
      std::fill_n(valid, frame.width(), std::uint8_t{1});
    } else {
      std::transform(frame.valid.row(y), frame.valid.row(y) + frame.width(), valid,
                     [](std::uint8_t given) { return given != 0 ? std::uint8_t{1} : given; });
    }
    if (values != nullptr) {
      for (int x = 0; x < frame.width(); ++x) {
        valid[x] = std::isfinite((*values)(x, y)) ? valid[x] : std::uint8_t{0};
      }
    }
  }
  if (!frame.valid.empty() || values != nullptr) {
    invalid.given = count_invalid();
  }
}

// Pixels that were given are filled first: whatever they hold, nothing is to be found there.
void Preprocessor::fill_invalid(InvalidPixels& invalid) {
  if (invalid.given > 0) {
    hole_filler_.fill(corrected_, valid_);
  }
  if (validity_options_.find) {
    invalid_finder_.run(corrected_, valid_, invalid);
    invalid.found = count_invalid() - invalid.given;
    if (invalid.found > 0) {
      hole_filler_.fill(corrected_, valid_);
    }
  }
  valid_view_ = {};
  if (invalid.given + invalid.found > 0) {
    valid_view_ = valid_;
  }
}

std::int64_t Preprocessor::count_invalid() const {
  std::int64_t number = 0;
  for (int y = 0; y < valid_.height(); ++y) {
    number += std::count(valid_.row(y), valid_.row(y) + valid_.width(), std::uint8_t{0});
  }
  return number;
}

}  // namespace thermedge
