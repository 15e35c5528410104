#include "thermedge/stages/preprocessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace thermedge {
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
  forget_fractions(corrections.bad_pixels);
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
  fractions_.resize(0, 0);
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
  const FloatScale scale = scale_chooser_.choose(values);
  corrections.counts_per_unit = scale.counts_per_unit;
  corrections.offset = scale.offset;
  to_counts(values, scale, corrected_);
  fractions_.resize(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y) {
    std::transform(values.row(y), values.row(y) + values.width(), corrected_.row(y),
                   fractions_.row(y), [&](float value, std::uint16_t count) {
                     const double fraction = scale.to_count(value) - count;
                     return std::abs(fraction) <= 0.5 ? static_cast<float>(fraction) : 0.0F;
                   });
  }
}

void Preprocessor::copy_corrected(ImageView<float> out) const {
  copy_pixels(corrected_.view(), out);
  for (int y = 0; y < fractions_.height(); ++y) {
    std::transform(fractions_.row(y), fractions_.row(y) + out.width(), out.row(y), out.row(y),
                   std::plus<>());
  }
}

// Pixels that were replaced have no value of their own.
void Preprocessor::forget_fractions(const std::vector<BadPixel>& replaced) {
  if (fractions_.empty()) {
    return;
  }
  for (int y = 0; y < fractions_.height(); ++y) {
    std::transform(fractions_.row(y), fractions_.row(y) + fractions_.width(), valid_.row(y),
                   fractions_.row(y),
                   [](float fraction, std::uint8_t valid) { return valid != 0 ? fraction : 0.0F; });
  }
  for (const BadPixel& pixel : replaced) {
    fractions_(pixel.x, pixel.y) = 0;
  }
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
