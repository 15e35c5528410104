// Denoisers for single frames: Gaussian, non-local means, BM3D.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "thermedge/image.hpp"
#include "thermedge/noise_model.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

enum class DenoiseMethod { kNone, kGaussian, kNlm, kBm3d };
inline constexpr std::array kDenoiseMethods = {
    EnumName{DenoiseMethod::kNone, "none"}, EnumName{DenoiseMethod::kGaussian, "gaussian"},
    EnumName{DenoiseMethod::kNlm, "nlm"}, EnumName{DenoiseMethod::kBm3d, "bm3d"}};

struct GaussianOptions {
  double sigma_px = 0;  // 0: the 5x5 kernel of eq. 5 (sum 159); else a Gaussian, 0.3..20 px
};

template <OptionsOf<GaussianOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("sigma_px", o.sigma_px, Bounds{0, 20}, "standard deviation, px (0: the 5x5 kernel of eq. 5)");
}

// Buades, Coll, Morel 2005; figures of the paper's author: patch 5, search 7, h 0.15 of the range.
// The outer half of the search disc is sampled on every other row and column: a third of the time,
// and less of the blur that many distant, half alike patches bring.
struct NlmOptions {
  int patch_px = 7;           // side of the compared patches, odd, 1..15; their middle weighs most
  int search_px = 21;         // diameter of the search disc, odd, 1..41; time grows with its square
  double h_over_sigma = 0.9;  // filter strength in units of the noise, 0.1..5
};

template <OptionsOf<NlmOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("patch_px", o.patch_px, Bounds{1, 15}, "side of the compared patches, odd, px");
  v("search_px", o.search_px, Bounds{1, 41}, "diameter of the search disc, odd, px");
  v("h_over_sigma", o.h_over_sigma, Bounds{0.1, 5}, "filter strength in units of the noise");
}

// How much time BM3D may take; docs/benchmarks.md has what each gives.
enum class Bm3dProfile { kQuality, kBalanced, kFast, kFastest };
inline constexpr std::array kBm3dProfiles = {
    EnumName{Bm3dProfile::kQuality, "quality"}, EnumName{Bm3dProfile::kBalanced, "balanced"},
    EnumName{Bm3dProfile::kFast, "fast"}, EnumName{Bm3dProfile::kFastest, "fastest"}};

// Dabov et al. 2007; the roles of the parameters as in Lebrun's analysis (IPOL 2012).
struct Bm3dOptions {
  Bm3dProfile profile = Bm3dProfile::kBalanced;
  double lambda = 2.6;       // hard threshold in units of sigma, 0.5..10
  double kaiser_beta = 2.0;  // window of the aggregation, 0..10
  bool wiener = true;        // run stage 2 (costs as much as stage 1, gives 0.3 to 0.6 dB)
  // Whether a block displaced by one pixel may join a group: keeps 0.05 dB more detail, and ripple
  // that looks like edges.
  bool adjacent_blocks = true;
  // Whether the coarsest slopes of a group's mean escape the hard threshold: gentle slopes of the
  // scene do not become terraces, which look like edges, and flat areas keep more noise.
  bool keep_slopes = false;
};

template <OptionsOf<Bm3dOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("profile", o.profile, kBm3dProfiles, "quality, balanced, fast or fastest");
  v("lambda", o.lambda, Bounds{0.5, 10}, "hard threshold in units of the noise");
  v("kaiser_beta", o.kaiser_beta, Bounds{0, 10}, "shape of the aggregation window");
  v("wiener", o.wiener, Bounds{0, 1}, "run the second stage");
  v("adjacent_blocks", o.adjacent_blocks, Bounds{0, 1},
    "blocks displaced by one pixel may join a group: more detail, and more ripple");
  v("keep_slopes", o.keep_slopes, Bounds{0, 1},
    "gentle slopes escape the hard threshold: no terraces, and more noise in flat areas");
}

// A bilateral filter after the method, far weaker than the noise: it evens out the ripple that
// block matching leaves in flat areas, and nothing else. Rows first, then columns (Pham & van Vliet
// 2005).
struct BilateralOptions {
  double range_sigmas = 0;  // differences evened out, in units of the noise; 0: off
  double space_px = 6;      // standard deviation of the weights over distance, 1..10
};

template <OptionsOf<BilateralOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("range_sigmas", o.range_sigmas, Bounds{0, 10},
    "range of the bilateral filter that follows the method, in units of the noise (0: off)");
  v("space_px", o.space_px, Bounds{1, 10}, "reach of the bilateral filter: standard deviation, px");
}

struct DenoiseOptions {
  DenoiseMethod method = DenoiseMethod::kBm3d;
  double sigma_counts = 0;  // noise told to nlm and bm3d, in counts; 0: as measured on the frame
  double sigma_scale = 1;   // factor on the noise that nlm and bm3d are told
  bool detrend = false;     // the smooth background is taken off before and put back after, so that
                            // no terraces are made of it
  GaussianOptions gaussian = {};
  NlmOptions nlm = {};
  Bm3dOptions bm3d = {};
  BilateralOptions bilateral = {};

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<DenoiseOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("method", o.method, kDenoiseMethods, "none, gaussian, nlm or bm3d");
  v("sigma_counts", o.sigma_counts, Bounds{0, 65535}, "noise, counts (0: measured on each frame)");
  v("sigma_scale", o.sigma_scale, Bounds{0.1, 10},
    "factor on the noise that nlm and bm3d are told");
  v("detrend", o.detrend, Bounds{0, 1},
    "subtract the smooth background before denoising and add it afterwards");
  v.group("gaussian", o.gaussian);
  v.group("nlm", o.nlm);
  v.group("bm3d", o.bm3d);
  v.group("bilateral", o.bilateral);
}

// Standard deviations of the Gaussian.
struct GaussianTuning {
  double cutoff_sigmas = 4;   // where the kernel ends: 6e-5 of its weight is beyond, against time
  double narrowest_px = 0.1;  // as good as no filter: neighbours weigh e^-50
};

struct NlmTuning {
  // Weights below e^-negligible_exponent are as good as none, which bounds the distances: the
  // levels of the pixels that patches are compared by are the finer the smaller it is.
  double negligible_exponent = 16;
};

// Where blocks are sought. Measured: docs/benchmarks.md, list of what each part of BM3D does.
struct Bm3dTuning {
  int dense_radius_px = 6;  // up to which all displacements are candidates, farther off every other
                            // one: half the distances, no loss that can be measured
  // Sides of the squares of displacements that give one block to a group, near by and farther off.
  // Blocks that overlap almost wholly share their noise; too large a side leaves out good matches.
  int dense_class_px = 2;
  int sparse_class_px = 4;
};

struct BilateralTuning {
  double reach_sigmas = 1.6;  // where the weights over distance end, in units of space_px: time
                              // against smoothness, e^-1.3 is cut off
};

// Not options: they belong to the methods as they are, and stay out of --dump-config.
struct DenoiseTuning {
  GaussianTuning gaussian = {};
  NlmTuning nlm = {};
  Bm3dTuning bm3d = {};
  BilateralTuning bilateral = {};
};

// To the nearest whole counts, within 0..65535. `out` has the size of `in`. Thread-safe.
void round_to_counts(ImageView<const float> in, ImageView<std::uint16_t> out);

// Runs the chosen method. Holds the scratch memory of a frame size: after the second frame of one
// size nothing is allocated. One Denoiser per thread; the work is spread over `runner`.
// The result is bit-identical for every ParallelRunner and SIMD target.
class Denoiser {
 public:
  explicit Denoiser(const DenoiseOptions& options, const DenoiseTuning& tuning = {});
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

  // The same for noise as it was measured, in the units of `in`: where there is none, which a level
  // of 0 says, there is nothing to remove and the frame is copied. BM3D is told the spectrum, and
  // all methods see the frame with the noise evened out by its map. `burden`, 0 to 1, says how much
  // of one the noise is: so large a share of options.bilateral.range_sigmas and of the Gaussian's
  // standard deviation is applied.
  [[nodiscard]] Status run_measured(ImageView<const float> in, const NoiseModel& noise,
                                    ImageView<float> out, ParallelRunner& runner,
                                    double burden = 1);

  // White noise of `sigma`, 0 where none was measured.
  [[nodiscard]] Status run_measured(ImageView<const float> in, double sigma, ImageView<float> out,
                                    ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
