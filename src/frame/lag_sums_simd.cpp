#include "lag_sums_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lag_sums_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void lag_sums(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
              int limit, ImageView<std::int16_t> sums, ImageView<std::int16_t> numbers) {
  const hn::CappedTag<std::uint16_t, 32> d;
  const hn::RebindToSigned<decltype(d)> di;
  using Ints = hn::Vec<decltype(di)>;
  const auto beyond = hn::Set(d, static_cast<std::uint16_t>(limit + 1));
  for (int x = 0; x + 1 < counts.width(); x += static_cast<int>(hn::Lanes(d))) {
    std::array<Ints, kLags.size()> sum;
    std::array<Ints, kLags.size()> number;
    sum.fill(hn::Zero(di));
    number.fill(hn::Zero(di));
    for (int y = 0; y < counts.height(); ++y) {
      const std::uint16_t* row = counts.row(y) + x;
      const auto a = hn::LoadU(d, row);
      const auto distance = hn::BitCast(di, hn::LoadU(d, reach.row(y / 2) + x));
      for (std::size_t i = 0; i < kLags.size(); ++i) {
        const auto b = hn::LoadU(d, row + kLags[i]);
        const auto near = hn::RebindMask(di, (hn::Max(a, b) - hn::Min(a, b)) < beyond);
        const auto open = distance > hn::Set(di, static_cast<std::int16_t>(kLags[i]));
        const auto counted = hn::And(near, open);
        sum[i] = sum[i] + hn::IfThenElseZero(counted, hn::BitCast(di, b - a));
        number[i] = number[i] - hn::VecFromMask(di, counted);  // true is -1
      }
    }
    for (std::size_t i = 0; i < kLags.size(); ++i) {
      hn::StoreU(sum[i], di, sums.row(static_cast<int>(i)) + x);
      hn::StoreU(number[i], di, numbers.row(static_cast<int>(i)) + x);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(lag_sums);

void lag_sums(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
              int limit, ImageView<std::int16_t> sums, ImageView<std::int16_t> numbers) {
  THERMEDGE_SIMD_DISPATCH(lag_sums)(counts, reach, limit, sums, numbers);
}

}  // namespace thermedge::detail
#endif
