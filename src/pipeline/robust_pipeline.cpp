#include "robust_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "order_statistics.hpp"
#include "stage_clock.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/stages/contrast.hpp"
#include "thermedge/stages/subpixel.hpp"
#include "try.hpp"

namespace thermedge::detail {

Status RobustPipeline::detect(const Frame& frame, const Call& call, Detection& found) {
  StageClock clock(found.times, call.stop);
  counts_ = preprocessor_.run(frame, call.runner, found.corrections);
  take_told_noise(found.corrections);
  find_noise_scale(found);
  THERMEDGE_TRY(clock.lap("correct", {}));
  call.tell_corrected(counts_, found.corrections);
  THERMEDGE_TRY(clock.lap("denoise", denoise(call.runner, found)));
  THERMEDGE_TRY(clock.lap("edge_pixels", find_edge_pixels(call.runner, found)));
  THERMEDGE_TRY(clock.lap("contours", graph_.run(pixels_.edges, pixels_.response, traced_)));
  THERMEDGE_TRY(clock.lap("gap_closing", close_gaps()));
  THERMEDGE_TRY(clock.lap("corners", corner_finder_.run(linked_.contours, corners_)));
  THERMEDGE_TRY(clock.lap(
      "scores", scorer_.run(linked_, corners_, pixels_.suppressed_response, found.edges)));
  test_edges(call.runner, found);
  THERMEDGE_TRY(clock.lap("significance", {}));
  refine_positions(pixels_.response, pixels_.kernel, found.sigma_counts / noise_.unit_counts,
                   found.edges, call.runner);
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
      preprocessor_(options.bad_pixels, options.stripes, options.validity, true),
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

// The level is the caller's word, its spectrum and map are still those of the frame.
void RobustPipeline::take_told_noise(Corrections& corrections) const {
  const double told = options_.denoise.sigma_counts * corrections.counts_per_unit;
  if (told > 0) {
    corrections.noise_model.level_counts = told;
  }
}

double noisiness_of(double level_counts, double pixel_sigma_counts,
                    const NoiseScaleTuning& tuning) {
  const double multiple = std::max(level_counts / tuning.no_noise_counts,
                                   pixel_sigma_counts / tuning.no_pixel_noise_counts);
  return std::clamp(multiple - 1, 0.0, 1.0);
}

void RobustPipeline::find_noise_scale(Detection& found) {
  const double level = found.corrections.noise_model.level_counts;
  noise_.noisiness = noisiness_of(level, found.corrections.noise.sigma_counts, tuning_);
  const double clean = 1 - noise_.noisiness;
  const double least = clean > 0 ? tuning_.least_contrast_share * usual_contrast() : 0;
  noise_.unit_counts =
      std::hypot(tuning_.unit_sigmas * level, clean * least, clean * tuning_.terrace_counts);
  found.sigma_counts = noise_.noisiness > 0 ? level : 0;
  found.unit_counts = noise_.unit_counts;
}

const NoiseModel& RobustPipeline::noise_to_mind(const Detection& found) const {
  return noise_.noisiness > 0 ? found.corrections.noise_model : no_noise_;
}

double RobustPipeline::usual_contrast() {
  const int side = tuning_.square_px;
  spans_.clear();
  spans_.reserve(counts_.size() / static_cast<std::size_t>(side * side) + 1);
  for (int y = 0; y + side <= counts_.height(); y += side) {
    for (int x = 0; x + side <= counts_.width(); x += side) {
      std::uint16_t least = counts_(x, y);
      std::uint16_t greatest = least;
      for (int j = y; j < y + side; ++j) {
        const auto [low, high] = std::minmax_element(counts_.row(j) + x, counts_.row(j) + x + side);
        least = std::min(least, *low);
        greatest = std::max(greatest, *high);
      }
      spans_.push_back(greatest - least);
    }
  }
  if (spans_.empty()) {
    return 0;
  }
  const auto rank =
      static_cast<std::size_t>(tuning_.usual_quantile * static_cast<double>(spans_.size() - 1));
  return nth_value(std::span(spans_), rank);
}

Status RobustPipeline::denoise(ParallelRunner& runner, Detection& found) {
  denoised_.resize(found.width, found.height);
  preprocessor_.copy_corrected(denoised_);
  const NoiseModel& noise = noise_to_mind(found);
  return denoiser_.run_measured(denoised_, noise, denoised_, runner, noise_.noisiness).map([&] {
    even_ = even_out(noise.map);
  });
}

// Distances from the mean over the level of the noise.
ImageView<const float> RobustPipeline::even_out(const NoiseLevelMap& map) {
  evened_.resize(denoised_.width(), denoised_.height());
  if (map.is_even()) {
    return denoised_;
  }
  std::uint64_t sum = 0;
  for (int y = 0; y < counts_.height(); ++y) {
    sum += std::accumulate(counts_.row(y), counts_.row(y) + counts_.width(), std::uint32_t{0});
  }
  const auto mean =
      static_cast<float>(static_cast<double>(sum) / static_cast<double>(counts_.size()));
  map.even_out(denoised_, mean, mean, evened_);
  return evened_;
}

Status RobustPipeline::find_edge_pixels(ParallelRunner& runner, Detection& found) {
  return filter_.run(even_, noise_.unit_counts, noise_.noisiness, runner)
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
  return gap_closer_.run(traced_, even_, eligible_, linked_, clear_view_);
}

// On the counts before denoising: a denoiser can invent an edge, the frame itself confirms it.
void RobustPipeline::test_edges(ParallelRunner& runner, Detection& found) {
  significance_.run(counts_, noise_to_mind(found), preprocessor_.valid(), pixels_, found.edges,
                    runner);
}

Status RobustPipeline::select(Detection& found) {
  return selector_.run(found.edges, found.corrections.counts_per_unit).map([&] {
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
    out->denoised_values.resize(0, 0);
    return {};
  }
  copy_image(ImageView<const float>(denoised_), out->denoised_values);
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
