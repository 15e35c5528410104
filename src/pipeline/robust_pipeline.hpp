// Presets robust and fast: on counts, in units of the noise.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "false_alarm_models.hpp"
#include "pipeline.hpp"
#include "thermedge/stages/corners.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/edge_graph.hpp"
#include "thermedge/stages/gap_closing.hpp"
#include "thermedge/stages/oriented_filter.hpp"
#include "thermedge/stages/preprocessor.hpp"
#include "thermedge/stages/scoring.hpp"
#include "thermedge/stages/selection.hpp"

namespace thermedge::detail {

// Measured on simulated frames of 130 counts of range with noise of 1 to 30 counts and stripes of a
// third of it (docs/tuning.md).
struct NoiseScaleTuning {
  // Noise below this share of the frame's range is none.
  double no_noise_share = 0.002;
  // Added to the noise where there is none, counts: without noise a slope comes as terraces of one
  // count, which are no edges.
  double rounding_counts = 10;
  // Noise-to-range ratio at which denoising starts (0) and reaches full strength (1). From the
  // first on a Gaussian blurs as much as its options say.
  double clean_share = 0.036;
  double full_share = 0.05;
  // Range: from this share of the pixels to one less this share, of every step-th pixel of every
  // step-th row; at least least_range_counts, of a frame without any contrast.
  double tail_share = 0.001;
  int sample_step_px = 4;
  double least_range_counts = 1;
  // Standard deviation of what removed stripes leave, in units of the noise and, of strong ones, as
  // a share of them: beside walls they cannot be told from the scene. Corrected counts are whole
  // numbers: 1 / sqrt(12) counts.
  double stripes_left_sigmas = 0.08;
  double stripes_left_share = 1.0 / 6;
  double count_step_deviation = 0.2887;
};

// The noise of one frame as the stages after it see it.
struct NoiseScale {
  double sigma_counts = 0;   // measured, or as told
  double range_counts = 1;   // 0.1st to 99.9th percentile of the frame
  double unit_counts = 1;    // what responses are in units of
  double kernel_share = 0;   // of the way from the clean kernels to those for noise, 0..1
  double denoise_share = 0;  // of the denoiser's full strength, 0..1
  bool is_noisy = false;     // else nothing is denoised, and every contrast is certain
};

class RobustPipeline final : public Pipeline {
 public:
  RobustPipeline(const DetectorOptions& options, const RobustOptions& own);

  Status detect(const Frame& frame, const Call& call, Detection& found) override;
  Status trace(ImageView<const std::uint8_t> edge_map, const Call& call, Detection& found) override;

  [[nodiscard]] std::size_t memory_bytes() const override {
    return memory_of(preprocessor_, denoiser_, filter_, graph_, gap_closer_, corner_finder_,
                     scorer_, selector_, budgets_, sample_, denoised_, clear_, masked_,
                     traced_.contours.points, traced_.contours.items, eligible_,
                     linked_.contours.points, linked_.contours.items, linked_.links,
                     corners_.indices, corners_.ranges);
  }

 private:
  void measure_noise_scale(Detection& found);
  [[nodiscard]] double measure_range();
  Status denoise(ParallelRunner& runner, Detection& found);
  Status find_edge_pixels(ParallelRunner& runner, Detection& found);
  [[nodiscard]] ImageView<const std::uint8_t> find_clear();
  Status close_gaps();
  void test_edges(Detection& found);
  Status select(Detection& found);
  Status keep_intermediates(int bits, Intermediates* out);

  DetectorOptions options_;
  OrientedFilterOptions filter_options_;
  NoiseScaleTuning tuning_;
  FalseAlarmLookup false_alarms_;
  Preprocessor preprocessor_;
  Denoiser denoiser_;
  OrientedFilterBank filter_;
  GraphTracer graph_;
  GapCloser gap_closer_;
  CornerFinder corner_finder_;
  Scorer scorer_;
  EdgeSelector selector_;
  EdgeSelector budgets_;  // without tests, which need a frame

  ImageView<const std::uint16_t> counts_;
  NoiseScale noise_;
  std::vector<std::uint16_t> sample_;
  Image<float> denoised_;        // counts
  OrientedFilterResult pixels_;  // views of what filter_ holds
  Image<std::uint8_t> clear_, masked_;
  ImageView<const std::uint8_t> clear_view_;  // of clear_; empty where edges can be everywhere
  LinkedContours traced_;                     // by the graph
  std::vector<std::uint8_t> eligible_;        // of its contours: whose gaps are closed
  LinkedContours linked_;
  CornerSet corners_;
};

}  // namespace thermedge::detail
