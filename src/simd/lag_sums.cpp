#include "simd/lag_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/lag_sums.cpp"
#include "simd/config.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void lag_sums(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach, int lag,
              int limit, std::int16_t* sums, std::int16_t* numbers) {
  const hn::CappedTag<std::uint16_t, 32> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto beyond = hn::Set(d, static_cast<std::uint16_t>(limit + 1));
  const auto distance = hn::Set(d, static_cast<std::uint16_t>(lag));
  const auto one = hn::Set(di, 1);
  for (int x = 0; x < counts.width() - lag; x += static_cast<int>(hn::Lanes(d))) {
    auto sum = hn::Zero(di);
    auto number = hn::Zero(di);
    for (int y = 0; y < counts.height(); ++y) {
      const auto a = hn::LoadU(d, counts.row(y) + x);
      const auto b = hn::LoadU(d, counts.row(y) + x + lag);
      const auto near = (hn::Max(a, b) - hn::Min(a, b)) < beyond;
      const auto open = hn::LoadU(d, reach.row(y / 2) + x) > distance;
      const auto counted = hn::RebindMask(di, hn::And(near, open));
      sum = sum + hn::IfThenElseZero(counted, hn::BitCast(di, b - a));
      number = number + hn::IfThenElseZero(counted, one);
    }
    hn::StoreU(sum, di, sums + x);
    hn::StoreU(number, di, numbers + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(lag_sums);

void lag_sums(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach, int lag,
              int limit, std::int16_t* sums, std::int16_t* numbers) {
  HWY_DYNAMIC_DISPATCH(lag_sums)(counts, reach, lag, limit, sums, numbers);
}

}  // namespace thermedge::detail
#endif
