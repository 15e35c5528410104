#include "column_shifts_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "column_shifts_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U16 = hn::CappedTag<std::uint16_t, 32>;
using I16 = hn::RebindToSigned<U16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(U16()));

// b - a within the range of 15 bits and a sign.
HWY_INLINE hn::Vec<I16> clamped_difference(hn::Vec<U16> a, hn::Vec<U16> b) {
  const U16 d;
  const I16 di;
  const auto most = hn::Set(d, std::uint16_t{32767});
  const auto above = hn::BitCast(di, hn::Min(hn::SaturatedSub(b, a), most));
  const auto below = hn::BitCast(di, hn::Min(hn::SaturatedSub(a, b), most));
  return above - below;
}

// How many of the differences at `x` are below `trial`, over the rows that are looked at.
HWY_INLINE hn::Vec<I16> count_smaller(ImageView<const std::uint16_t> counts, int row_step, int x,
                                      hn::Vec<I16> trial) {
  const U16 d;
  const I16 di;
  auto smaller = hn::Zero(di);
  const auto look_at = [&](int y) {
    const std::uint16_t* row = counts.row(y) + x;
    const auto difference = clamped_difference(hn::LoadU(d, row), hn::LoadU(d, row + 1));
    smaller = smaller - hn::VecFromMask(di, difference < trial);  // true is -1
  };
  int y = 0;
  for (; 2 * y < counts.height() - 1; y += row_step) {
    look_at(y);
    look_at(counts.height() - 1 - y);
  }
  if (2 * y == counts.height() - 1) {
    look_at(y);
  }
  return smaller;
}

void neighbour_medians(ImageView<const std::uint16_t> counts, int row_step, int unit,
                       std::int16_t* medians) {
  const I16 di;
  const auto set = [=](int value) { return hn::Set(di, static_cast<std::int16_t>(value)); };
  int looked_at = 0;
  for (int y = 0; 2 * y <= counts.height() - 1; y += row_step) {
    looked_at += 2 * y == counts.height() - 1 ? 1 : 2;
  }
  for (int x = 0; x + 1 < counts.width(); x += kLanes) {
    auto lower = set(-kMedianSteps / 2 * unit);
    for (int step = kMedianSteps / 2; step > 0; step /= 2) {
      const auto trial = lower + set(step * unit);
      const auto smaller = count_smaller(counts, row_step, x, trial);
      lower = hn::IfThenElse(smaller > set(looked_at / 2), lower, trial);
    }
    hn::StoreU(lower + set(unit / 2), di, medians + x);
  }
}

void shift_columns(const std::uint16_t* down, const std::uint16_t* up,
                   ImageView<std::uint16_t> counts) {
  const U16 d;
  for (int y = 0; y < counts.height(); ++y) {
    std::uint16_t* row = counts.row(y);
    for (int x = 0; x < counts.width(); x += kLanes) {
      const auto lowered = hn::SaturatedSub(hn::LoadU(d, row + x), hn::LoadU(d, down + x));
      hn::StoreU(hn::SaturatedAdd(lowered, hn::LoadU(d, up + x)), d, row + x);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(neighbour_medians);
HWY_EXPORT(shift_columns);

void neighbour_medians(ImageView<const std::uint16_t> counts, int row_step, int unit,
                       std::int16_t* medians) {
  THERMEDGE_SIMD_DISPATCH(neighbour_medians)(counts, row_step, unit, medians);
}

void shift_columns(const std::uint16_t* down, const std::uint16_t* up,
                   ImageView<std::uint16_t> counts) {
  THERMEDGE_SIMD_DISPATCH(shift_columns)(down, up, counts);
}

}  // namespace thermedge::detail
#endif
