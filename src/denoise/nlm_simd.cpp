#include "nlm_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nlm_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U16 = hn::CappedTag<std::uint16_t, kNlmSlack>;
using F32 = hn::CappedTag<float, kNlmSlack / 2>;
using Floats = hn::Vec<F32>;

// squares[x] = min(|a[x] - b[x]|, 255)^2
void squared_differences(const std::uint16_t* a, const std::uint16_t* b, int width,
                         std::uint16_t* squares) {
  const U16 d;
  const hn::RebindToSigned<U16> signed_tag;
  const auto largest = hn::Set(d, 255);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const auto difference = hn::BitCast(signed_tag, hn::LoadU(d, a + x) - hn::LoadU(d, b + x));
    const auto level = hn::Min(hn::BitCast(d, hn::Abs(difference)), largest);
    hn::StoreU(level * level, d, squares + x);
  }
}

// sums[x] = sum of `count` elements, `step` apart, the first at values[x]. Sums that stop at the
// largest value are the same in any order. `sums` may be `values` where step > 1.
void running_sums(const std::uint16_t* values, std::ptrdiff_t step, int count, int width,
                  std::uint16_t* sums) {
  const U16 d;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    auto sum = hn::LoadU(d, values + x);
    for (int i = 1; i < count; ++i) {
      sum = hn::SaturatedAdd(sum, hn::LoadU(d, values + x + i * step));
    }
    hn::StoreU(sum, d, sums + x);
  }
}

// 2^-x for 0 <= x <= 100, error below 1.1e-4 of it: 2^-n times a polynomial for 2^-f.
HWY_INLINE Floats exp2_minus(Floats exponent) {
  const F32 d;
  const hn::RebindToSigned<F32> d32;
  const auto whole = hn::ConvertTo(d32, exponent);  // towards zero, so down
  const auto fraction = exponent - hn::ConvertTo(d, whole);
  auto sum = hn::Set(d, -0.0391339850F);
  sum = sum * fraction + hn::Set(d, 0.230555796F);
  sum = sum * fraction + hn::Set(d, -0.691421812F);
  sum = sum * fraction + hn::Set(d, 1.0F);
  return hn::BitCast(d, hn::BitCast(d32, sum) - hn::ShiftLeft<23>(whole));
}

// The weights of one vector of distances.
HWY_INLINE Floats weights_of(const std::uint16_t* distances, const NlmWeights& weigh) {
  const F32 d;
  const hn::RebindToSigned<F32> d32;
  const hn::Rebind<std::uint16_t, F32> d16;
  const auto distance = hn::ConvertTo(d, hn::PromoteTo(d32, hn::LoadU(d16, distances)));
  const auto excess = hn::Max(distance - hn::Set(d, weigh.noise), hn::Zero(d));
  const auto far = distance >= hn::Set(d, static_cast<float>(kLargestDistance));
  return hn::IfThenZeroElse(far, exp2_minus(excess * hn::Set(d, weigh.halvings)));
}

class Band {
 public:
  Band(const NlmBand& band, int patch_px, int search_px, const NlmWeights& weigh)
      : band_(band),
        patch_(patch_px),
        half_(nlm_patch_half(patch_px)),
        reach_(search_px / 2),
        weigh_(weigh) {}

  // Twice the sums over half_ neighbours make the triangular weights, along rows, then columns.
  void add_displacement(int dx, int dy) const {
    const int rows = band_.sums.height();
    for (int row = 0; row < rows + patch_ - 1; ++row) {
      sum_along_row(row, dx, dy);
    }
    const std::ptrdiff_t stride = band_.boxes.stride();
    for (int row = 0; row < rows + half_ - 1; ++row) {
      running_sums(band_.boxes.row(row), stride, half_, band_.width, band_.boxes.row(row));
    }
    for (int row = 0; row < rows; ++row) {
      running_sums(band_.boxes.row(row), stride, half_, band_.width, scratch_row(0));
      weigh_row(row, dx, dy);
    }
  }

 private:
  // boxes(x, row) = weighted distance of the two rows of patch_ pixels that begin at column x.
  void sum_along_row(int row, int dx, int dy) const {
    const int y = band_.first_row + reach_ + row;
    squared_differences(band_.levels.row(y) + reach_, band_.levels.row(y + dy) + reach_ + dx,
                        band_.width + patch_ - 1, scratch_row(0));
    running_sums(scratch_row(0), 1, half_, band_.width + half_ - 1, scratch_row(1));
    running_sums(scratch_row(1), 1, half_, band_.width, band_.boxes.row(row));
  }

  // Adds the displacement's share, whose distances are in scratch_row(0).
  void weigh_row(int row, int dx, int dy) const {
    const F32 d;
    const int margin = reach_ + patch_ / 2;
    const float* values = band_.values.row(band_.first_row + row + margin + dy) + margin + dx;
    float* sums = band_.sums.row(row);
    float* weights = band_.weights.row(row);
    for (int x = 0; x < band_.width; x += static_cast<int>(hn::Lanes(d))) {
      const auto weight = weights_of(scratch_row(0) + x, weigh_);
      hn::StoreU(hn::LoadU(d, sums + x) + weight * hn::LoadU(d, values + x), d, sums + x);
      hn::StoreU(hn::LoadU(d, weights + x) + weight, d, weights + x);
    }
  }

  std::uint16_t* scratch_row(int index) const {
    return band_.boxes.row(band_.boxes.height() - kNlmScratchRows + index);
  }

  const NlmBand& band_;
  int patch_;
  int half_;
  int reach_;
  NlmWeights weigh_;
};

void nlm_band(const NlmBand& band, int patch_px, int search_px, const NlmWeights& weights) {
  fill_pixels(band.sums, 0.0F);
  fill_pixels(band.weights, 0.0F);
  const Band kernel(band, patch_px, search_px, weights);
  const int reach = search_px / 2;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (nlm_samples(dx, dy, reach)) {
        kernel.add_displacement(dx, dy);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(nlm_band);

void nlm_band(const NlmBand& band, int patch_px, int search_px, const NlmWeights& weights) {
  THERMEDGE_SIMD_DISPATCH(nlm_band)(band, patch_px, search_px, weights);
}

}  // namespace thermedge::detail
#endif
