// Denoisers for single frames: Gaussian, non-local means, BM3D.
#pragma once

#include <cstdint>
#include <memory>

#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

enum class DenoiseMethod { kNone, kGaussian, kNlm, kBm3d };

struct GaussianOptions {
  double sigma_px = 0;  // 0: the 5x5 kernel of eq. 5 (sum 159); else a Gaussian, 0.3..20 px
};

// Buades, Coll, Morel 2005; figures of the paper's author: patch 5, search 7, h 0.15 of the range.
// The outer half of the search disc is sampled on every other row and column: a third of the time,
// and less of the blur that many distant, half alike patches bring.
struct NlmOptions {
  int patch_px = 7;           // side of the compared patches, odd, 1..15; their middle weighs most
  int search_px = 21;         // diameter of the search disc, odd, 1..41; time grows with its square
  double h_over_sigma = 0.9;  // filter strength in units of the noise, 0.1..5
};

// How much time BM3D may take; docs/benchmarks.md has what each gives.
enum class Bm3dProfile { kQuality, kBalanced, kFast };

// Dabov et al. 2007; the roles of the parameters as in Lebrun's analysis (IPOL 2012).
struct Bm3dOptions {
  Bm3dProfile profile = Bm3dProfile::kBalanced;
  double lambda = 2.6;       // hard threshold in units of sigma, 0.5..10
  double kaiser_beta = 2.0;  // window of the aggregation, 0..10
  bool wiener = true;        // run stage 2 (costs as much as stage 1, gives 0.3 to 0.6 dB)
};

// A bilateral filter behind the method, far weaker than the noise: it evens out the bilateral that
// block matching leaves in flat areas, and nothing else. Rows first, then columns (Pham & van Vliet
// 2005).
struct BilateralOptions {
  double range_sigmas = 0;  // differences evened out, in units of the noise; 0: off
  double space_px = 6;      // standard deviation of the weights over distance, 1..10
};

struct DenoiseOptions {
  DenoiseMethod method = DenoiseMethod::kBm3d;
  double sigma_counts = 0;  // noise told to nlm and bm3d, in counts; 0: as measured on the frame
  double sigma_scale = 1;   // nlm and bm3d are told so many times the noise
  bool detrend = false;     // the smooth background is taken off before and put back after, so that
                            // no terraces are made of it
  GaussianOptions gaussian;
  NlmOptions nlm;
  Bm3dOptions bm3d;
  BilateralOptions bilateral;
};

// To the nearest whole counts, within 0..65535. `out` has the size of `in`. Thread-safe.
void round_to_counts(ImageView<const float> in, ImageView<std::uint16_t> out);

// Runs the chosen method. Holds the scratch memory of a frame size: after the second frame of one
// size nothing is allocated. One Denoiser per thread; the work is spread over `runner`.
// The result is bit-identical for every ParallelRunner and SIMD target.
class Denoiser {
 public:
  explicit Denoiser(const DenoiseOptions& options);
  Denoiser(Denoiser&&) noexcept;
  Denoiser& operator=(Denoiser&&) noexcept;
  ~Denoiser();

  // `in` -> `out`, same size, values up to 1e36; `sigma` is the noise in the units of `in`
  // (options.sigma_counts is for the caller to interpret). `out` may be `in`.
  // Errors: sizes differ or empty; a pixel is NaN or infinite; an option out of range; for nlm and
  // bm3d, sigma not positive and finite; for bm3d, a side under 8 px; out of memory. A sigma below
  // 1e-15 of the frame's range copies the frame.
  [[nodiscard]] Status run(ImageView<const float> in, double sigma, ImageView<float> out,
                           ParallelRunner& runner);

  // The same for the `sigma` that NoiseEstimator measured: where it found none, which it says with
  // 0, there is nothing to remove and the frame is copied. `burden`, 0 to 1, says how much
  // of one the noise is: so large a share of options.bilateral.range_sigmas and of the Gaussian's
  // standard deviation is applied.
  [[nodiscard]] Status run_measured(ImageView<const float> in, double sigma, ImageView<float> out,
                                    ParallelRunner& runner, double burden = 1);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
