// Fixed offsets of columns and rows, measured on one frame so that edges of the scene survive.
#pragma once

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

// In counts; empty where the frame shows no stripes, or is too small to tell.
struct StripeOffsets {
  std::vector<float> columns;
  std::vector<float> rows;
};

// Stripes are white: neighbouring columns have nothing to do with each other. An edge of the scene
// that runs along a column is one lasting jump, or is there on some of the rows only. So:
// differences between columns at several lags, over the parts of their height where no edge lies
// between them (found on the frame corrected so far); the offsets by least squares from these;
// lasting jumps of their profile, found by a two-sided window test, are left to the scene; and
// shrinkage by what the pixel noise alone would make of the offsets. The same for rows.
//
// On simulated frames of 382x288 with stripes of sigma / 3: an upright edge of 1 sigma keeps 0.9 of
// its contrast over 40 % of the height and 0.85 over all of it, or more (means); stripes of 0.06
// sigma are left where the scene is open, of 0.1 sigma where it is crowded (pixel noise alone makes
// that 0.06). One object per thread; allocates on the first frame of a size only. The same result
// for every ParallelRunner and SIMD target.
class StripeFinder {
 public:
  StripeFinder();
  StripeFinder(StripeFinder&&) noexcept;
  StripeFinder& operator=(StripeFinder&&) noexcept;
  ~StripeFinder();

  // `frame` without dead pixels, `sigma_counts` its pixel noise, as NoiseEstimator measures it.
  // Sides under 64 px along or across give no offsets, nor does a sigma of 0.
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
