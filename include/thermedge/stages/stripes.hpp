// Fixed offsets of columns and rows, measured on one frame so that edges of the scene survive.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct StripeOptions {
  bool remove = false;  // remove the fixed offsets of columns and rows

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<StripeOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("remove", o.remove, Bounds{0, 1}, "remove the fixed offsets of columns and rows");
}

// Which pixels say nothing about stripes because an edge of the scene lies between them. Unit of
// length: squares of 2x2 pixels. The mask as a whole is measured in docs/experiments.md ("stripes:
// a mask for each direction"); no field was varied there on its own.
struct StripeMaskTuning {
  // Half the heights of the windows in which long faint edges show, squares: a taller one sees
  // fainter edges, a lower one shorter edges.
  std::array<int, 2> long_reach_squares = {5, 13};
  double long_z = 2.5;  // least z of a window's mean: lower marks noise, higher leaves edges
  double most_step_sigmas = 2.5;  // largest step that counts, in units of a step's noise, so that a
                                  // short strong edge is no long faint one
  // Quantile of the windows up to which there are no edges, 0..1; and the z below which this share
  // of normal values lies, P(|Z| < z). The two belong together.
  double edgeless_quantile = 0.2;
  double edgeless_quantile_z = 0.2533;
  int sample_step_squares = 5;  // rows between those that the quantile is taken of: precision
                                // against time
};

// The measurements above StripeFinder are those of these values together. Where a line names no
// measurement, it tells what the value trades off.
struct StripeTuning {
  // The rough start: the medians of the differences between neighbouring columns over every so
  // many-th row, to within so much of the pixel noise. More of either is slower, and as good.
  int start_row_step = 8;
  double start_unit_sigmas = 0.25;
  // These medians are taken off where they spread by so much of the pixel noise: weaker stripes are
  // within edge_sigmas as they are. A median beyond so many of its deviations is an edge.
  double start_deviation_sigmas = 1;
  double start_edge_deviations = 5;
  // Differences between two pixels beyond this many sigma are edges of the scene, whatever the mask
  // says: white noise is beyond 5 sigma, 3.5 of a difference, once in 2500 pairs.
  double edge_sigmas = 5;
  // Least gradient of an edge in each round after the first, in units of what pixel noise makes of
  // it. Stripes are still in the way in the earlier ones.
  std::array<double, 2> edge_gradients = {5.0, 4.5};
  // The trend of a smooth scene, such as that of a lens darker towards the corners, is a polynomial
  // (docs/experiments.md, "Stripes"). First of slopes, from every so many-th column: 8 see it less
  // well.
  int slope_step_px = 4;
  // It counts as far as it exceeds so many deviations of the stripes: a lower value takes strong
  // stripes for a trend, a higher one the flanks of vignetting for jumps. From so many on, rms, it
  // is a dome, on which jumps are looked for twice.
  double steep_trend_deviations = 1.5;
  double dome_deviations = 10;
  // Then of the profile; z that a term has to exceed, and by which its square is reduced: lower
  // ones leave smooth parts of strong stripes.
  double trend_z = 3;
  // Least z of a lasting jump of the profile: a lower one leaves stripes beside jumps that are none
  // (of 6: a tenth more on domes and in scenes), a higher one takes edges along a whole column for
  // stripes.
  double jump_z = 7;
  std::size_t most_jumps = 24;  // bounds the time
  // Samples to either side that the test of a jump compares: long ones see small jumps, short ones
  // two that are close. A constant, as the table of their deviations has its size.
  static constexpr std::array kJumpWindows = {5, 8, 12, 18, 26};
  int shortest_jump_side = 3;     // samples on either side of a jump
  double least_pair_share = 0.1;  // of the height over which two columns are seen side by side,
                                  // 0..1: fewer rows are too noisy
  // Stripes are there where the variance of the offsets is this many times what pixel noise makes
  // of them: a lower one removes offsets that are noise.
  double least_variance_ratio = 1.5;
  // Weight of the differences against the prior that offsets are small: as good as no prior, to see
  // jumps; and for the result, where stripes have usual_stripes_sigmas. It grows with the square of
  // stronger ones.
  double no_prior = 1e4;
  double prior = 2;
  double usual_stripes_sigmas = 1.0 / 3;  // in units of the pixel noise (simulated PI450)
  // Stripes from here on, in units of the pixel noise, leave so much before the last round that it
  // looks like long faint edges, which are not looked for then.
  double strong_stripes_sigmas = 0.6;
  int smallest_side_px =
      64;  // shorter sides give no offsets: too few columns tell jumps from stripes
  StripeMaskTuning mask = {};
};

// In counts; empty where the frame shows no stripes, or is too small to tell.
struct StripeOffsets {
  std::vector<float> columns;
  std::vector<float> rows;
};

// Stripes are white: neighbouring columns have nothing to do with each other. An edge of the scene
// that runs along a column is one lasting jump, or is there on some of the rows only. So: strong
// stripes are taken off by medians, whatever their strength; then differences between columns at
// several lags, over the parts of their height where no edge lies between them, all on the frame
// corrected so far; the offsets by least squares from these; a smooth trend of their profile and
// its lasting jumps, found by a two-sided window test, are left to the scene; and shrinkage by what
// the pixel noise alone would make of the offsets. The same for rows.
//
// On simulated frames of 382x288 with stripes of sigma / 3: an upright edge of 1 sigma keeps 0.9 of
// its contrast over 40 % of the height and 0.85 over all of it, or more (means); stripes of 0.06
// sigma are left where the scene is open, of 0.1 sigma where it is crowded (pixel noise alone makes
// that 0.06). Of stripes of 3 sigma 0.06 are left where there is nothing else and 0.25 in a crowded
// scene, whose edges along a whole column are seen from 5 sigma on. One object per thread;
// allocates on the first frame of a size only. The same result for every ParallelRunner and SIMD
// target.
class StripeFinder {
 public:
  explicit StripeFinder(const StripeTuning& tuning = {});
  StripeFinder(StripeFinder&&) noexcept;
  StripeFinder& operator=(StripeFinder&&) noexcept;
  ~StripeFinder();

  // `frame` without dead pixels, `sigma_counts` its pixel noise, as NoiseEstimator measures it.
  // Sides under smallest_side_px along or across give no offsets, nor does a sigma of 0.
  void measure(ImageView<const std::uint16_t> frame, double sigma_counts, ParallelRunner& runner,
               StripeOffsets& offsets);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// frame(x, y) less its column's and its row's offset, rounded, within 0..65535, in place.
void remove_stripes(const StripeOffsets& offsets, ImageView<std::uint16_t> frame);

}  // namespace thermedge
