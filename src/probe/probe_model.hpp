// The noise model of a recording, as the detector measures it on each frame.
#pragma once

#include <array>
#include <vector>

#include "probe_counts.hpp"
#include "thermedge/image.hpp"
#include "thermedge/probe/probe.hpp"
#include "thermedge/stages/noise_model_estimator.hpp"

namespace thermedge::detail {

class RecordingNoise {
 public:
  explicit RecordingNoise(Preset preset) : preset_(preset) {}

  // Measures a frame whose invalid pixels (0 in `valid`; empty: none) have been filled; all frames
  // have one size. Returns the noise that the detector would tell of it, counts.
  double add(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> valid,
             double pixel_sigma_counts);

  // Sigma, spectrum, kind and map.
  void report(RecordingReport& result) const;

 private:
  void add_map(int width, int height, double sigma_counts);

  Preset preset_;
  NoiseModelEstimator estimator_;
  NoiseModel model_;
  Mean sigma_;
  double squares_ = 0;                                                // of the levels, counts^2
  std::array<double, std::tuple_size_v<NoiseSpectrum>> variances_{};  // counts^2, added up
  int tile_columns_ = 0;
  std::vector<double> tile_sums_;  // of sigma, counts
};

}  // namespace thermedge::detail
