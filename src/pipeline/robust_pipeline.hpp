// Presets robust and fast: on counts, in units of the noise.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline.hpp"
#include "thermedge/stages/corners.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/edge_graph.hpp"
#include "thermedge/stages/gap_closing.hpp"
#include "thermedge/stages/oriented_filter.hpp"
#include "thermedge/stages/preprocessor.hpp"
#include "thermedge/stages/scoring.hpp"
#include "thermedge/stages/selection.hpp"
#include "thermedge/stages/significance.hpp"

namespace thermedge::detail {

// What responses are in units of. Measured on simulated scenes of eleven conditions
// (docs/experiments.md, "Unit").
struct NoiseScaleTuning {
  // Unit of responses, in units of the noise's level: a smaller one lets noise through to the
  // tests, a larger one loses faint edges before them.
  double unit_sigmas = 1.62;
  // Noise up to this level at the scale of edges, and this deviation from pixel to pixel, counts,
  // is as good as none, and from twice one of them on it is all there is. Rounding to whole counts
  // has .29; smooth scenes without noise look like .7 to 1.3 at the scale of edges.
  double no_noise_counts = 1.5;
  double no_pixel_noise_counts = 0.3;
  // Without noise, what is hardly there beside the usual edges of the frame is shading: the unit
  // is at least this share of their contrast, for which stands the span of counts that a tenth of
  // all squares of this side exceed (a small hot thing does not change it); and at least so many
  // counts, because a slope comes as terraces of one count.
  double least_contrast_share = 0.25;
  double usual_quantile = 0.9;
  int square_px = 8;
  double terrace_counts = 10;
};

// 0: noise is as good as none, 1: it is all that limits what can be told. Of its level at the scale
// of edges and its deviation from pixel to pixel.
[[nodiscard]] double noisiness_of(double level_counts, double pixel_sigma_counts,
                                  const NoiseScaleTuning& tuning = {});

// The noise of one frame as the stages after it see it.
struct NoiseScale {
  double unit_counts = 1;  // what responses are in units of, where the noise's map is 1
  double noisiness = 0;    // as noisiness_of has it
};

class RobustPipeline final : public Pipeline {
 public:
  RobustPipeline(const DetectorOptions& options, const RobustOptions& own);

  Status detect(const Frame& frame, const Call& call, Detection& found) override;
  Status trace(ImageView<const std::uint8_t> edge_map, const Call& call, Detection& found) override;

  [[nodiscard]] std::size_t memory_bytes() const override {
    return memory_of(preprocessor_, denoiser_, filter_, graph_, gap_closer_, corner_finder_,
                     scorer_, significance_, selector_, budgets_, spans_, denoised_, evened_,
                     clear_, masked_, traced_.contours.points, traced_.contours.items, eligible_,
                     linked_.contours.points, linked_.contours.items, linked_.links,
                     corners_.indices, corners_.ranges);
  }

 private:
  void take_told_noise(Corrections& corrections) const;
  void find_noise_scale(Detection& found);
  [[nodiscard]] double usual_contrast();
  // No noise where it is as good as none.
  [[nodiscard]] const NoiseModel& noise_to_mind(const Detection& found) const;
  Status denoise(ParallelRunner& runner, Detection& found);
  [[nodiscard]] ImageView<const float> even_out(const NoiseLevelMap& map);
  Status find_edge_pixels(ParallelRunner& runner, Detection& found);
  [[nodiscard]] ImageView<const std::uint8_t> find_clear();
  Status close_gaps();
  void test_edges(ParallelRunner& runner, Detection& found);
  Status select(Detection& found);
  Status keep_intermediates(int bits, Intermediates* out);

  DetectorOptions options_;
  OrientedFilterOptions filter_options_;
  NoiseScaleTuning tuning_;
  Preprocessor preprocessor_;
  Denoiser denoiser_;
  OrientedFilterBank filter_;
  GraphTracer graph_;
  GapCloser gap_closer_;
  CornerFinder corner_finder_;
  Scorer scorer_;
  SignificanceTest significance_;
  EdgeSelector selector_;
  EdgeSelector budgets_;  // without tests, which need a frame

  ImageView<const std::uint16_t> counts_;
  NoiseScale noise_;
  NoiseModel no_noise_;
  std::vector<int> spans_;
  Image<float> denoised_;        // counts
  Image<float> evened_;          // over the level of the noise
  ImageView<const float> even_;  // denoised counts with the same noise everywhere
  OrientedFilterResult pixels_;  // views of what filter_ holds
  Image<std::uint8_t> clear_, masked_;
  ImageView<const std::uint8_t> clear_view_;  // of clear_; empty where edges can be everywhere
  LinkedContours traced_;                     // by the graph
  std::vector<std::uint8_t> eligible_;        // of its contours: whose gaps are closed
  LinkedContours linked_;
  CornerSet corners_;
};

}  // namespace thermedge::detail
