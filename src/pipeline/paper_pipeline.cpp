#include "paper_pipeline.hpp"

#include "stage_clock.hpp"
#include "thermedge/stages/contrast.hpp"
#include "try.hpp"

namespace thermedge::detail {

// Algorithm 6, step by step. Before it, bad pixels are replaced; linking comes before corners,
// which would be found again on the linked contours anyway; at the end, contrast and significance.
Status PaperPipeline::detect(const Frame& frame, const Call& call, Detection& found) {
  StageClock clock(found.times, call.stop);
  counts_ = preprocessor_.run(frame, call.runner, found.corrections);
  THERMEDGE_TRY(clock.lap("correct", {}));
  call.tell_corrected(counts_, found.corrections);
  THERMEDGE_TRY(clock.lap("scale", scale(frame.bits, found)));
  THERMEDGE_TRY(clock.lap("denoise", denoise(frame.bits, call.runner, found)));
  THERMEDGE_TRY(clock.lap("edge_pixels", find_edge_pixels(call.runner, found)));
  THERMEDGE_TRY(trace_and_score(clock, found));
  measure_contrast(counts_, found.corrections.noise.sigma_counts, found.edges);
  THERMEDGE_TRY(clock.lap("significance", {}));
  THERMEDGE_TRY(clock.lap("selection", selector_.run(found.edges)));
  mark_cut_ends(preprocessor_.valid(), found.edges);
  keep_intermediates(call.intermediates);
  convert_to_frame_units(found);
  return {};
}

Status PaperPipeline::trace(ImageView<const std::uint8_t> edge_map, const Call& call,
                            Detection& found) {
  StageClock clock(found.times, call.stop);
  binarize(edge_map, masked_);
  counts_ = {};
  levels_.resize(0, 0);
  denoised_.resize(0, 0);
  edge_map_ = masked_;
  THERMEDGE_TRY(trace_and_score(clock, found));
  set_normals_from_shape(found.edges);
  forget_contrast(found.edges);
  THERMEDGE_TRY(clock.lap("selection", budgets_.run(found.edges)));
  keep_intermediates(call.intermediates);
  return {};
}

// Algorithms 3 to 6: contours, links, corners, scores.
Status PaperPipeline::trace_and_score(StageClock& clock, Detection& found) {
  THERMEDGE_TRY(clock.lap("contours", tracer_.run(edge_map_, contours_)));
  THERMEDGE_TRY(clock.lap("linking", linker_.run(contours_, found.width, found.height, linked_)));
  THERMEDGE_TRY(clock.lap("corners", find_corners()));
  return clock.lap("scores",
                   scorer_.run(linked_, corners_, found.width, found.height, found.edges));
}

PaperPipeline::PaperPipeline(const DetectorOptions& options, const PaperOptions& own)
    : told_sigma_counts_(options.denoise.sigma_counts),
      grey_scale_(own.grey_scale),
      linking_(own.linking),
      corner_options_(own.corners),
      preprocessor_(options.bad_pixels, options.stripes, options.validity, false),
      denoiser_(options.denoise),
      canny_(own.canny),
      tracer_(own.contours),
      linker_(own.linking),
      corner_finder_(own.corners),
      scorer_(own.scoring),
      selector_(options.selection),
      budgets_({.keep_edges = options.selection.keep_edges,
                .max_edgels = options.selection.max_edgels}) {}

// Algorithm 1. 8-bit pictures are grey levels already.
Status PaperPipeline::scale(int bits, Detection& found) {
  levels_.resize(counts_.width(), counts_.height());
  if (bits == 8) {
    copy_pixels(counts_, levels_.view());
    return {};
  }
  found.clipped = clipped_shares(counts_, grey_scale_, preprocessor_.valid());
  return scale_to_8bit(counts_, grey_scale_, levels_);
}

// Section 4.2, step 1. The noise in grey levels is the noise in counts times the gain.
Status PaperPipeline::denoise(int bits, ParallelRunner& runner, Detection& found) {
  const Corrections& corrections = found.corrections;
  found.sigma_counts = told_sigma_counts_ > 0 ? told_sigma_counts_ * corrections.counts_per_unit
                                              : corrections.noise.sigma_counts;
  const double levels_per_count = bits == 8 ? 1.0 : grey_scale_.gain;
  denoised_.resize(found.width, found.height);
  copy_pixels(levels_.view(), denoised_.view());
  return denoiser_.run_measured(denoised_, found.sigma_counts * levels_per_count, denoised_,
                                runner);
}

// Algorithm 2.
Status PaperPipeline::find_edge_pixels(ParallelRunner& runner, Detection& found) {
  return canny_.run(denoised_, runner).map([&](const CannyResult& pixels) {
    const ImageView<const std::uint8_t> valid = preprocessor_.valid();
    if (!valid.empty()) {
      keep_clear_of_invalid(valid, clear_);
    }
    edge_map_ = mask_invalid(
        pixels.edges, valid.empty() ? valid : ImageView<const std::uint8_t>(clear_), masked_);
    found.threshold_low = pixels.low;
    found.threshold_high = pixels.high;
  });
}

// Algorithm 4. A contour that linking closed has no ends, so no two corners at its seam.
Status PaperPipeline::find_corners() {
  return corner_finder_.run(linked_.contours, corners_).map([&] {
    if (linking_.gap_px > 0) {
      merge_seam_corners(linked_.contours, corner_options_.end_distance_px, corners_);
    }
  });
}

void PaperPipeline::keep_intermediates(Intermediates* out) const {
  if (out == nullptr) {
    return;
  }
  copy_image(counts_, out->corrected);
  copy_image(levels_.view(), out->levels);
  round_to_levels(denoised_, out->denoised);
  copy_image(ImageView<const float>(denoised_), out->denoised_values);
  copy_image(edge_map_, out->edge_map);
  out->contours = contours_;
  out->linked = linked_;
}

}  // namespace thermedge::detail
