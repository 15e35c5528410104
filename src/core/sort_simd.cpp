#include "sort_simd.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sort_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::CappedTag<double, 8>;
using I64 = hn::RebindToSigned<F64>;
constexpr std::size_t kLanes = hn::MaxLanes(F64());

// Of equal values the one that was before the other stays there.
void sort_few(std::span<double> values) {
  const F64 d;
  const I64 di;
  const std::size_t count = values.size();
  HWY_ALIGN double before[kFewValues + kLanes];
  std::copy(values.begin(), values.end(), before);
  std::fill_n(before + count, kLanes, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; i += kLanes) {
    const auto self = hn::Load(d, before + i);
    const std::size_t end = std::min(i + kLanes, count);
    auto place = hn::Zero(di);
    const auto add = [&](auto goes_before) HWY_ATTR {
      place = place - hn::VecFromMask(di, hn::RebindMask(di, goes_before));  // true is -1
    };
    for (std::size_t k = 0; k < i; ++k) {
      add(hn::Set(d, before[k]) <= self);
    }
    for (std::size_t k = i; k < end; ++k) {
      const auto other = hn::Set(d, before[k]);
      const auto is_later = hn::Iota(d, 0) > hn::Set(d, static_cast<double>(k - i));
      add(hn::Or(other < self, hn::And(other == self, is_later)));
    }
    for (std::size_t k = end; k < count; ++k) {
      add(hn::Set(d, before[k]) < self);
    }
    HWY_ALIGN std::int64_t places[kLanes];
    hn::Store(place, di, places);
    for (std::size_t k = i; k < end; ++k) {
      values[static_cast<std::size_t>(places[k - i])] = before[k];
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(sort_few);

void sort_few(std::span<double> values) {
  assert(values.size() <= kFewValues);
  THERMEDGE_SIMD_DISPATCH(sort_few)(values);
}

}  // namespace thermedge::detail
#endif
