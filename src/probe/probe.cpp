#include "thermedge/probe/probe.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <new>

#include "probe_counts.hpp"
#include "probe_degrees.hpp"
#include "probe_input.hpp"
#include "probe_model.hpp"
#include "probe_motion.hpp"
#include "probe_noise.hpp"
#include "probe_stripes.hpp"
#include "thermedge/stages/hole_filling.hpp"
#include "thermedge/stages/noise.hpp"
#include "thermedge/stages/validity.hpp"

namespace thermedge {
namespace {

using detail::Mean;

// Algorithm 1's default among round steps to both sides of it.
constexpr std::array kGains = {10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005};

bool same_counts(ImageView<const std::uint16_t> a, ImageView<const std::uint16_t> b) {
  for (int y = 0; y < a.height(); ++y) {
    if (!std::equal(a.row(y), a.row(y) + a.width(), b.row(y))) {
      return false;
    }
  }
  return true;
}

// Median over the pixels of b - a.
double median_change(ImageView<const std::uint16_t> a, ImageView<const std::uint16_t> b,
                     std::vector<int>& changes) {
  changes.clear();
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      changes.push_back(b(x, y) - a(x, y));
    }
  }
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>((changes.size() - 1) / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return *middle;
}

// Keeps every n-th sample, n doubled whenever there are too many.
class Series {
 public:
  explicit Series(std::size_t most_samples) : most_samples_(most_samples) {
    samples_.reserve(most_samples);
  }
  void add(const ProbeSample& sample) {
    if (sample.frame % step_ != 0) {
      return;
    }
    if (samples_.size() == most_samples_) {
      step_ *= 2;
      std::erase_if(samples_, [&](const ProbeSample& kept) { return kept.frame % step_ != 0; });
    }
    if (sample.frame % step_ == 0) {
      samples_.push_back(sample);
    }
  }
  [[nodiscard]] const std::vector<ProbeSample>& samples() const { return samples_; }

 private:
  std::size_t most_samples_;
  std::vector<ProbeSample> samples_;
  std::int64_t step_ = 1;
};

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

struct RecordingProbe::Impl {
  Impl(const ProbeOptions& chosen, const ProbeTuning& chosen_tuning)
      : options(chosen),
        tuning(chosen_tuning),
        model(chosen.preset),
        series(chosen_tuning.most_samples) {}

  ProbeOptions options;
  ProbeTuning tuning;
  RecordingReport report;  // what is counted up; the rest is filled in by finish()
  std::uint16_t bits_set = 0;
  std::int64_t freeze = 0;  // repeats since the last new frame
  int last_median = 0;

  detail::SortedCounts sorted;
  detail::CountTotals totals;
  detail::RecordingNoise model;
  detail::TiledNoise noise;
  detail::MotionGate gate;
  detail::StripeProfiles stripes;
  NoiseEstimator estimator;
  Series series;
  detail::InputFaultFinder input_faults;
  double counts_per_unit = 0;  // of the last frame
  InvalidFinder invalid_finder;
  HoleFiller hole_filler;
  Mean given_invalid, found_invalid, dead_rows, dead_columns;
  Mean range, robust_range, frame_sigma, column_sigma, row_sigma, flicker;
  std::array<Mean, kGains.size()> clipped;

  Image<std::uint16_t> previous, working, filled;
  Image<std::uint8_t> valid;
  std::vector<int> changes;
  std::vector<BadPixel> dead;
  Image<std::uint32_t> dead_frames;  // in how many frames each pixel was flagged
  std::int64_t flags = 0;
  std::int64_t new_frames = 0;  // frames that repeat none

  Status check(ImageView<const std::uint16_t> frame, int bits);
  void reserve(ImageView<const std::uint16_t> frame);
  void add(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> given);
  void fill_invalid(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> given);
  void add_counts(ImageView<const std::uint16_t> frame);
  void add_new_frame(ImageView<const std::uint16_t> frame, double sigma_counts,
                     double pixel_sigma_counts);
  void add_bad_pixels(ImageView<const std::uint16_t> frame, double sigma_counts);
  void end_freeze(ImageView<const std::uint16_t> frame, double sigma_counts);
  [[nodiscard]] RecordingReport finish() const;
  void finish_noise(RecordingReport& result) const;
  void finish_bad_pixels(RecordingReport& result) const;
};

Status RecordingProbe::Impl::check(ImageView<const std::uint16_t> frame, int bits) {
  if (frame.empty()) {
    return failure(ErrorCode::kInvalidArgument, "frame without pixels");
  }
  if (bits != 8 && bits != 16) {
    return failure(ErrorCode::kInvalidArgument,
                   "frame of " + std::to_string(bits) + " bits; should be 8 or 16");
  }
  if (report.frames == 0) {
    report.width = frame.width();
    report.height = frame.height();
    report.container_bits = bits;
  }
  if (frame.width() != report.width || frame.height() != report.height) {
    return failure(ErrorCode::kInvalidArgument,
                   "frame of " + size_text(frame.width(), frame.height()) +
                       " pixels in a recording of " + size_text(report.width, report.height) +
                       "; left out");
  }
  if (bits != report.container_bits) {
    return failure(ErrorCode::kInvalidArgument,
                   "frame of " + std::to_string(bits) + " bits in a recording of " +
                       std::to_string(report.container_bits) + "; left out");
  }
  return {};
}

// All memory that frames of this size can need.
void RecordingProbe::Impl::reserve(ImageView<const std::uint16_t> frame) {
  previous.resize(frame.width(), frame.height());
  working.resize(frame.width(), frame.height());
  filled.resize(frame.width(), frame.height());
  valid.resize(frame.width(), frame.height());
  invalid_finder.prepare(frame.width(), frame.height());
  hole_filler.prepare(frame.width(), frame.height());
  dead_frames.resize(frame.width(), frame.height());
  fill_pixels(dead_frames.view(), 0U);
  dead.reserve(frame.size());
  changes.reserve(frame.size());
}

// The frame as the detector's front end fills it.
void RecordingProbe::Impl::fill_invalid(ImageView<const std::uint16_t> frame,
                                        ImageView<const std::uint8_t> given) {
  const auto count = [&] {
    std::int64_t number = 0;
    for (int y = 0; y < valid.height(); ++y) {
      number += std::count(valid.row(y), valid.row(y) + valid.width(), std::uint8_t{0});
    }
    return number;
  };
  InvalidPixels invalid;
  copy_pixels(frame, filled.view());
  fill_pixels(valid.view(), std::uint8_t{1});
  if (!given.empty()) {
    copy_pixels(given, valid.view());
    invalid.given = count();
  }
  if (invalid.given > 0) {
    hole_filler.fill(filled, valid);
  }
  if (options.validity.find) {
    invalid_finder.run(filled, valid, invalid);
    invalid.found = count() - invalid.given;
  }
  if (invalid.found > 0) {
    hole_filler.fill(filled, valid);
  }
  given_invalid.add(static_cast<double>(invalid.given));
  found_invalid.add(static_cast<double>(invalid.found));
  dead_rows.add(invalid.dead_rows);
  dead_columns.add(invalid.dead_columns);
}

void RecordingProbe::Impl::add(ImageView<const std::uint16_t> frame_as_given,
                               ImageView<const std::uint8_t> given) {
  if (report.frames == 0) {
    reserve(frame_as_given);
  }
  fill_invalid(frame_as_given, given);
  const ImageView<const std::uint16_t> frame = filled;
  const bool is_repeat = report.frames > 0 && same_counts(frame, previous);
  add_counts(frame);
  const NoiseEstimate estimate = estimator.measure(frame);
  frame_sigma.add(estimate.sigma_counts);
  column_sigma.add(estimate.column_sigma_counts);
  row_sigma.add(estimate.row_sigma_counts);
  const double sigma = model.add(frame, valid, estimate.sigma_counts);
  const double pixel_sigma = noise.add(frame);
  series.add({report.frames, last_median, sigma});
  if (is_repeat) {
    ++report.repeated_frames;
    report.longest_freeze = std::max(report.longest_freeze, ++freeze);
  } else {
    add_new_frame(frame, sigma, pixel_sigma);
  }
  ++report.frames;
}

void RecordingProbe::Impl::add_counts(ImageView<const std::uint16_t> frame) {
  sorted.sort(frame);
  totals.add(sorted);
  const bool is_first = report.frames == 0;
  report.min_counts = is_first ? sorted.min() : std::min(report.min_counts, sorted.min());
  report.max_counts = is_first ? sorted.max() : std::max(report.max_counts, sorted.max());
  range.add(sorted.max() - sorted.min());
  robust_range.add(sorted.quantile(1 - tuning.range_tail_share) -
                   sorted.quantile(tuning.range_tail_share));
  for (std::size_t i = 0; i < kGains.size(); ++i) {
    clipped[i].add(sorted.clipped_share(kGains[i]));
  }
  const int median = sorted.quantile(0.5);
  if (!is_first) {
    flicker.add(std::abs(median - last_median));
  }
  last_median = median;
  for (int y = 0; y < frame.height(); ++y) {
    const std::uint16_t* row = frame.row(y);
    for (int x = 0; x < frame.width(); ++x) {
      bits_set |= row[x];
    }
  }
}

void RecordingProbe::Impl::add_new_frame(ImageView<const std::uint16_t> frame, double sigma_counts,
                                         double pixel_sigma_counts) {
  ++new_frames;
  if (new_frames > 1) {
    end_freeze(frame, pixel_sigma_counts);
    noise.add_change();
  }
  if (gate.moved(frame, pixel_sigma_counts)) {
    noise.add_to_pattern();
    report.scene_moved += new_frames > 1 ? 1 : 0;
  }
  stripes.add(frame);
  add_bad_pixels(frame, sigma_counts);
  copy_pixels(frame, previous.view());
}

void RecordingProbe::Impl::end_freeze(ImageView<const std::uint16_t> frame, double sigma_counts) {
  if (freeze >= tuning.shutter_repeats) {
    const double jump = median_change(previous, frame, changes);
    if (std::abs(jump) > sigma_counts) {
      ++report.offset_jumps;
      report.largest_jump_counts = std::max(report.largest_jump_counts, std::abs(jump));
    }
  }
  freeze = 0;
}

void RecordingProbe::Impl::add_bad_pixels(ImageView<const std::uint16_t> frame,
                                          double sigma_counts) {
  copy_pixels(frame, working.view());
  replace_bad_pixels(working, sigma_counts, options.bad_pixels, dead);
  for (const BadPixel& pixel : dead) {
    ++dead_frames(pixel.x, pixel.y);
  }
  flags += static_cast<std::int64_t>(dead.size());
}

RecordingReport RecordingProbe::Impl::finish() const {
  RecordingReport result = report;
  if (report.frames == 0) {
    return result;
  }
  result.used_bits = std::bit_width(bits_set);
  result.unused_low_bits =
      totals.distinct() < tuning.least_values_for_shift ? 0 : std::countr_zero(bits_set);
  result.range_counts = range.value();
  result.robust_range_counts = robust_range.value();
  result.histogram = totals.histogram();
  result.given_invalid_pixels = given_invalid.value();
  result.found_invalid_pixels = found_invalid.value();
  result.dead_rows = dead_rows.value();
  result.dead_columns = dead_columns.value();
  finish_noise(result);
  detail::fill_degrees(options, totals.quantile(tuning.range_tail_share),
                       totals.quantile(1 - tuning.range_tail_share), result);
  result.input = input_faults.faults();
  finish_bad_pixels(result);
  for (std::size_t i = 0; i < kGains.size(); ++i) {
    result.clipping.push_back({kGains[i], clipped[i].value()});
  }
  if (flicker.count() > 0) {
    result.flicker_counts = flicker.value();
  }
  result.series = series.samples();
  result.preset = options.preset;
  result.suggested = suggest_options(result, result.preset, tuning.suggestions);
  return result;
}

void RecordingProbe::Impl::finish_noise(RecordingReport& result) const {
  model.report(result);
  if (counts_per_unit > 0) {
    result.sigma_value = result.sigma_counts / counts_per_unit;
  }
  result.pixel_sigma_counts = noise.sigma_counts();
  result.frame_sigma_counts = frame_sigma.value();
  result.temporal_sigma_counts = noise.temporal_sigma_counts();
  if (result.sigma_counts > 0) {
    result.snr = result.robust_range_counts / result.sigma_counts;
  }
  if (const auto pattern = noise.pattern()) {
    constexpr double kFramesOfAShortMap = 8;
    result.fixed_pattern_sigma_counts = pattern->sigma_counts;
    result.fixed_pattern_share = pattern->share;
    const double rest = 1 - pattern->share;
    result.offset_map_gain_limit = 1 - std::sqrt(rest);
    result.offset_map_gain_8_frames =
        std::max(1 - std::sqrt(rest * (1 + 1 / kFramesOfAShortMap)), 0.0);
  }
  result.column_sigma_counts = column_sigma.value();
  result.row_sigma_counts = row_sigma.value();
  result.column_profile_counts = stripes.columns();
  result.row_profile_counts = stripes.rows();
}

void RecordingProbe::Impl::finish_bad_pixels(RecordingReport& result) const {
  std::int64_t lasting = 0;
  std::int64_t lasting_flags = 0;
  if (new_frames >= tuning.least_frames_for_dead_pixels) {
    for (int y = 0; y < dead_frames.height(); ++y) {
      for (int x = 0; x < dead_frames.width(); ++x) {
        const std::int64_t frames = dead_frames(x, y);
        if (2 * frames >= new_frames) {
          ++lasting;
          lasting_flags += frames;
        }
      }
    }
    result.bad_pixels = lasting;
  }
  result.passing_bad_pixels =
      static_cast<double>(flags - lasting_flags) / static_cast<double>(new_frames);
}

double RecordingReport::clipped_share(double gain) const {
  for (const GainClipping& entry : clipping) {
    if (entry.gain == gain) {
      return entry.share;
    }
  }
  return 0;
}

RecordingProbe::RecordingProbe(const ProbeOptions& options, const ProbeTuning& tuning)
    : impl_(std::make_unique<Impl>(options, tuning)) {}
RecordingProbe::RecordingProbe(RecordingProbe&&) noexcept = default;
RecordingProbe& RecordingProbe::operator=(RecordingProbe&&) noexcept = default;
RecordingProbe::~RecordingProbe() = default;

Status RecordingProbe::add(ImageView<const std::uint16_t> frame, int bits,
                           ImageView<const std::uint8_t> valid, double counts_per_unit) {
  if (!valid.empty() && !same_size(frame, valid)) {
    return failure(ErrorCode::kInvalidArgument,
                   "validity mask of " + size_text(valid.width(), valid.height()) +
                       " pixels for a frame of " + size_text(frame.width(), frame.height()) +
                       "; left out");
  }
  return impl_->check(frame, bits).and_then([&]() -> Status {
    try {
      impl_->counts_per_unit = counts_per_unit;
      if (impl_->options.find_input_faults && counts_per_unit == 0) {
        impl_->input_faults.add(frame, valid, bits);
      }
      impl_->add(frame, valid);
    } catch (const std::bad_alloc&) {
      return failure(ErrorCode::kOutOfMemory, "not enough memory for a frame of " +
                                                  size_text(frame.width(), frame.height()));
    }
    return {};
  });
}

RecordingReport RecordingProbe::report() const { return impl_->finish(); }

}  // namespace thermedge
