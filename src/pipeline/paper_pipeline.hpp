// Preset paper: what the text of the paper says.
#pragma once

#include "pipeline.hpp"
#include "thermedge/stages/canny.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/corners_paper.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/linking.hpp"
#include "thermedge/stages/preprocessor.hpp"
#include "thermedge/stages/scoring.hpp"
#include "thermedge/stages/selection.hpp"

namespace thermedge::detail {

class StageClock;

class PaperPipeline final : public Pipeline {
 public:
  PaperPipeline(const DetectorOptions& options, const PaperOptions& own);

  Status detect(const Frame& frame, const Call& call, Detection& found) override;
  Status trace(ImageView<const std::uint8_t> edge_map, const Call& call, Detection& found) override;

  [[nodiscard]] std::size_t memory_bytes() const override {
    return memory_of(preprocessor_, denoiser_, canny_, tracer_, linker_, corner_finder_, scorer_,
                     selector_, budgets_, levels_, denoised_, clear_, masked_, contours_.points,
                     contours_.items, linked_.contours.points, linked_.contours.items,
                     linked_.links, corners_.indices, corners_.ranges);
  }

 private:
  Status scale(int bits, Detection& found);
  Status denoise(int bits, ParallelRunner& runner, Detection& found);
  Status find_edge_pixels(ParallelRunner& runner, Detection& found);
  Status find_corners();
  Status trace_and_score(StageClock& clock, Detection& found);
  void keep_intermediates(Intermediates* out) const;

  double told_sigma_counts_;
  GreyScaleOptions grey_scale_;
  LinkingOptions linking_;
  PaperCornerOptions corner_options_;
  Preprocessor preprocessor_;
  Denoiser denoiser_;
  Canny canny_;
  ContourTracer tracer_;
  Linker linker_;
  PaperCornerFinder corner_finder_;
  Scorer scorer_;
  EdgeSelector selector_;
  EdgeSelector budgets_;  // without tests, which need a frame

  ImageView<const std::uint16_t> counts_;
  ImageView<const std::uint8_t> edge_map_;
  Image<std::uint8_t> levels_;
  Image<float> denoised_;  // grey levels
  Image<std::uint8_t> clear_, masked_;
  ContourSet contours_;
  LinkedContours linked_;
  CornerSet corners_;
};

}  // namespace thermedge::detail
