#include "robust_pipeline.hpp"

#include <cmath>
#include <span>

#include "stage_clock.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/stages/contrast.hpp"
#include "thermedge/stages/significance.hpp"
#include "thermedge/stages/subpixel.hpp"
#include "try.hpp"

namespace thermedge::detail {

Status RobustPipeline::detect(const Frame& frame, const Call& call, Detection& found) {
  StageClock clock(found.times, call.stop);
  counts_ = preprocessor_.run(frame, call.runner, found.corrections);
  measure_noise_scale(found);
  THERMEDGE_TRY(clock.lap("correct", {}));
  THERMEDGE_TRY(clock.lap("denoise", denoise(call.runner, found)));
  THERMEDGE_TRY(clock.lap("edge_pixels", find_edge_pixels(call.runner, found)));
  THERMEDGE_TRY(clock.lap("contours", graph_.run(pixels_.edges, pixels_.response, traced_)));
  THERMEDGE_TRY(clock.lap("gap_closing", close_gaps()));
  THERMEDGE_TRY(clock.lap("corners", corner_finder_.run(linked_.contours, corners_)));
  THERMEDGE_TRY(clock.lap(
      "scores", scorer_.run(linked_, corners_, pixels_.suppressed_response, found.edges)));
  test_edges(found);
  THERMEDGE_TRY(clock.lap("significance", {}));
  refine_positions(pixels_.response, pixels_.kernel, noise_.sigma_counts / noise_.unit_counts,
                   found.edges);
  THERMEDGE_TRY(clock.lap("positions", {}));
  THERMEDGE_TRY(clock.lap("selection", select(found)));
  mark_cut_ends(preprocessor_.valid(), found.edges);
  THERMEDGE_TRY(keep_intermediates(frame.bits, call.intermediates));
  convert_to_frame_units(found);
  return {};
}

// All pixels of the map have the same response, and no frame tells which gaps an edge goes on over.
Status RobustPipeline::trace(ImageView<const std::uint8_t> edge_map, const Call& call,
                             Detection& found) {
  StageClock clock(found.times, call.stop);
  counts_ = {};
  denoised_.resize(found.width, found.height);
  fill_pixels(denoised_.view(), 1.0F);
  binarize(edge_map, masked_);
  pixels_ = {};
  pixels_.edges = masked_;
  THERMEDGE_TRY(clock.lap("contours", graph_.run(pixels_.edges, denoised_, traced_)));
  eligible_.assign(traced_.contours.items.size(), 0);
  THERMEDGE_TRY(clock.lap("gap_closing", gap_closer_.run(traced_, denoised_, eligible_, linked_)));
  THERMEDGE_TRY(clock.lap("corners", corner_finder_.run(linked_.contours, corners_)));
  THERMEDGE_TRY(
      clock.lap("scores", scorer_.run(linked_, corners_, found.width, found.height, found.edges)));
  set_normals_from_shape(found.edges);
  forget_contrast(found.edges);
  THERMEDGE_TRY(clock.lap("selection", budgets_.run(found.edges)));
  return keep_intermediates(8, call.intermediates);
}

RobustPipeline::RobustPipeline(const DetectorOptions& options, const RobustOptions& own)
    : options_(options),
      filter_options_(own.oriented_filter),
      false_alarms_(look_up_false_alarms(options.denoise, own.oriented_filter)),
      preprocessor_(options.bad_pixels, options.stripes, options.validity),
      denoiser_(options.denoise),
      filter_(own.oriented_filter),
      graph_(own.graph),
      gap_closer_(own.gap_closing),
      corner_finder_(own.corners),
      scorer_({}),
      selector_(options.selection),
      budgets_({.keep_edges = options.selection.keep_edges,
                .max_edgels = options.selection.max_edgels,
                .min_score = -1e9,
                .max_false_alarms = 0}) {}

void RobustPipeline::measure_noise_scale(Detection& found) {
  const double told = options_.denoise.sigma_counts * found.corrections.counts_per_unit;
  const double sigma = told > 0 ? told : found.corrections.noise.sigma_counts;
  const double range = measure_range();
  noise_.sigma_counts = sigma;
  noise_.range_counts = range;
  noise_.is_noisy = sigma > tuning_.no_noise_share * range;
  const double rounding = noise_.is_noisy ? 0 : tuning_.rounding_counts;
  noise_.unit_counts = std::hypot(sigma, filter_options_.noise_floor * range, rounding);
  noise_.kernel_share = std::clamp(
      (sigma / range - tuning_.clean_share) / (tuning_.full_share - tuning_.clean_share), 0.0, 1.0);
  // Where there is hardly any noise a Gaussian only blurs; and the ripple that BM3D leaves comes
  // with strong noise: taking it off steepens slopes.
  const bool blurs = options_.denoise.method == DenoiseMethod::kGaussian;
  noise_.denoise_share =
      blurs ? std::min(sigma / range / tuning_.clean_share, 1.0) : noise_.kernel_share;
  found.sigma_counts = noise_.is_noisy ? sigma : 0;
  found.range_counts = range;
  found.unit_counts = noise_.unit_counts;
}

// The sampled pixels of a mirrored frame are the mirrored ones.
double RobustPipeline::measure_range() {
  const auto is_sampled = [&](int i, int size) {
    return std::min(i, size - 1 - i) % tuning_.sample_step_px == 0;
  };
  sample_.clear();
  for (int y = 0; y < counts_.height(); ++y) {
    if (!is_sampled(y, counts_.height())) {
      continue;
    }
    for (int x = 0; x < counts_.width(); ++x) {
      if (is_sampled(x, counts_.width())) {
        sample_.push_back(counts_(x, y));
      }
    }
  }
  const auto quantile = [&](double share) {
    const auto at = sample_.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(sample_.size() - 1));
    std::nth_element(sample_.begin(), at, sample_.end());
    return static_cast<double>(*at);
  };
  return std::max(quantile(1 - tuning_.tail_share) - quantile(tuning_.tail_share),
                  tuning_.least_range_counts);
}

Status RobustPipeline::denoise(ParallelRunner& runner, Detection& found) {
  denoised_.resize(found.width, found.height);
  copy_pixels(counts_, denoised_.view());
  return denoiser_.run_measured(denoised_, found.sigma_counts, denoised_, runner,
                                noise_.denoise_share);
}

Status RobustPipeline::find_edge_pixels(ParallelRunner& runner, Detection& found) {
  return filter_.run(denoised_, noise_.unit_counts, noise_.kernel_share, runner)
      .map([&](const OrientedFilterResult& pixels) {
        pixels_ = pixels;
        pixels_.edges = mask_invalid(pixels.edges, find_clear(), masked_);
        found.kernel_px = pixels.kernel;
        found.threshold_low = filter_options_.low;
        found.threshold_high = filter_options_.high;
      });
}

ImageView<const std::uint8_t> RobustPipeline::find_clear() {
  clear_.resize(denoised_.width(), denoised_.height());
  clear_view_ = {};
  if (!preprocessor_.valid().empty()) {
    keep_clear_of_invalid(preprocessor_.valid(), clear_);
    clear_view_ = clear_;
  }
  return clear_view_;
}

// Gaps of contours that are too weak to be kept are not worth closing.
Status RobustPipeline::close_gaps() {
  eligible_.reserve(traced_.contours.items.capacity());
  eligible_.clear();
  for (const Contour& contour : traced_.contours.items) {
    const double score = saliency(traced_.contours.pixels(contour), pixels_.suppressed_response);
    eligible_.push_back(score >= options_.selection.min_score ? 1 : 0);
  }
  return gap_closer_.run(traced_, denoised_, eligible_, linked_, clear_view_);
}

// On the counts before denoising: a denoiser can invent an edge, the frame itself confirms it.
void RobustPipeline::test_edges(Detection& found) {
  const auto root_mean_square = [](std::span<const float> values) {
    double sum = 0;
    for (const float value : values) {
      sum += static_cast<double>(value) * value;
    }
    return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
  };
  const StripeOffsets& stripes = found.corrections.stripes;
  const double strength =
      std::max(root_mean_square(stripes.columns), root_mean_square(stripes.rows)) /
      noise_.sigma_counts;
  const double left = std::max(tuning_.stripes_left_sigmas, tuning_.stripes_left_share * strength);
  const double stripe_sigmas =
      strength > 0 ? std::hypot(left, tuning_.count_step_deviation / noise_.sigma_counts) : 0;
  test_significance(counts_, found.sigma_counts, pixels_.direction,
                    {.stripe_sigmas = stripe_sigmas, .model = false_alarms_.model}, found.edges);
  found.no_false_alarm_model = false_alarms_.why_none;
}

Status RobustPipeline::select(Detection& found) {
  return selector_.run(found.edges).map([&] {
    selector_.keep_junctions(found.width, found.height, found.edges);
  });
}

// The 8-bit views are those of preset paper.
Status RobustPipeline::keep_intermediates(int bits, Intermediates* out) {
  if (out == nullptr) {
    return {};
  }
  copy_image(pixels_.edges, out->edge_map);
  out->contours = traced_.contours;
  out->linked = linked_;
  copy_image(counts_, out->corrected);
  out->levels.resize(counts_.width(), counts_.height());
  if (counts_.empty()) {
    out->denoised.resize(0, 0);
    return {};
  }
  if (bits == 8) {
    copy_pixels(counts_, out->levels.view());
    round_to_levels(denoised_, out->denoised);
    return {};
  }
  Image<std::uint16_t> rounded(counts_.width(), counts_.height());
  round_to_counts(denoised_, rounded);
  out->denoised.resize(counts_.width(), counts_.height());
  THERMEDGE_TRY(scale_to_8bit(counts_, {}, out->levels));
  return scale_to_8bit(rounded, {}, out->denoised);
}

}  // namespace thermedge::detail
