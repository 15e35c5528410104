#include "stripe_mask_simd.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stripe_mask_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using I32 = hn::CappedTag<std::int32_t, 16>;
using Ints = hn::Vec<I32>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(I32()));

// Sums of pairs of neighbouring counts.
HWY_INLINE Ints pair_sums(const std::uint16_t* counts) {
  const I32 d;
  const hn::Rebind<std::uint16_t, I32> d16;
  hn::Vec<decltype(d16)> even;
  hn::Vec<decltype(d16)> odd;
  hn::LoadInterleaved2(d16, counts, even, odd);
  return hn::PromoteTo(d, even) + hn::PromoteTo(d, odd);
}

void square_row(const std::uint16_t* upper, const std::uint16_t* lower,
                const std::int32_t* of_columns, std::int32_t of_row, int count,
                std::int32_t* sums) {
  const I32 d;
  for (int i = 0; i < count; i += kLanes) {
    const auto counts = pair_sums(upper + 2 * i) + pair_sums(lower + 2 * i);
    const auto twice = hn::ShiftLeft<1>(counts - hn::LoadU(d, of_columns + i));
    hn::StoreU(twice - hn::Set(d, of_row), d, sums + i);
  }
}

void binomial_row(const std::int32_t* centre, std::ptrdiff_t step, int count, std::int32_t* out) {
  const I32 d;
  for (int i = 0; i < count; i += kLanes) {
    const auto at = [&](int k) { return hn::LoadU(d, centre + i + k * step); };
    const auto middle = at(0);
    const auto sum =
        at(-2) + at(2) + hn::ShiftLeft<2>(at(-1) + at(1) + middle) + hn::ShiftLeft<1>(middle);
    hn::StoreU(sum, d, out + i);
  }
}

void clamped_difference_row(const std::int32_t* ahead, const std::int32_t* behind,
                            std::int32_t most, int count, std::int32_t* out) {
  const I32 d;
  for (int i = 0; i < count; i += kLanes) {
    const auto difference = hn::LoadU(d, ahead + i) - hn::LoadU(d, behind + i);
    hn::StoreU(hn::Min(hn::Max(difference, hn::Set(d, -most)), hn::Set(d, most)), d, out + i);
  }
}

void slide_row(const std::int32_t* before, const std::int32_t* added, const std::int32_t* dropped,
               int count, std::int32_t* out) {
  const I32 d;
  for (int i = 0; i < count; i += kLanes) {
    const auto sum = hn::LoadU(d, before + i) + hn::LoadU(d, added + i);
    hn::StoreU(sum - hn::LoadU(d, dropped + i), d, out + i);
  }
}

// 1 where |values| > limit.
HWY_INLINE auto marks_beyond(Ints values, std::int32_t limit) {
  const I32 d;
  const hn::Rebind<std::uint8_t, I32> d8;
  return hn::DemoteTo(d8, hn::IfThenElseZero(hn::Abs(values) > hn::Set(d, limit), hn::Set(d, 1)));
}

void mark_beyond_row(const std::int32_t* values, std::int32_t limit, int count,
                     std::uint8_t* marks) {
  const hn::Rebind<std::uint8_t, I32> d8;
  for (int i = 0; i < count; i += kLanes) {
    const auto beyond = marks_beyond(hn::LoadU(I32(), values + i), limit);
    hn::StoreU(hn::Or(hn::LoadU(d8, marks + i), beyond), d8, marks + i);
  }
}

void mark_gradients_row(const std::int32_t* centre, std::ptrdiff_t stride, std::int32_t limit,
                        int count, std::uint8_t* upright, std::uint8_t* level) {
  const I32 d;
  const hn::Rebind<std::uint8_t, I32> d8;
  for (int i = 0; i < count; i += kLanes) {
    const auto at = [&](int x, int y) { return hn::LoadU(d, centre + i + y * stride + x); };
    const auto falling = at(1, 1) - at(-1, -1);
    const auto rising = at(1, -1) - at(-1, 1);
    const auto gx = falling + rising + hn::ShiftLeft<1>(at(1, 0) - at(-1, 0));
    const auto gy = falling - rising + hn::ShiftLeft<1>(at(0, 1) - at(0, -1));
    hn::StoreU(marks_beyond(gx, limit), d8, upright + i);
    hn::StoreU(marks_beyond(gy, limit), d8, level + i);
  }
}

void reach_row(const std::uint8_t* marks, int count, std::uint16_t* reach) {
  const I32 d;
  const hn::Rebind<std::uint8_t, I32> d8;
  const hn::Rebind<std::uint16_t, I32> d16;
  for (int i = 0; i < count; i += kLanes) {
    auto squares = hn::Set(d8, static_cast<std::uint8_t>(kFarSquares));
    for (int k = kFarSquares - 1; k >= 0; --k) {
      const auto is_open = hn::LoadU(d8, marks + i + k) == hn::Zero(d8);
      squares = hn::IfThenElse(is_open, squares, hn::Set(d8, static_cast<std::uint8_t>(k)));
    }
    const auto even = hn::ShiftLeft<1>(hn::PromoteTo(d, squares));
    const auto odd = hn::Max(even, hn::Set(d, 1)) - hn::Set(d, 1);
    hn::StoreInterleaved2(hn::DemoteTo(d16, even), hn::DemoteTo(d16, odd), d16, reach + 2 * i);
  }
}

float less_offsets(float count, float of_column, float of_row) {
  return std::min(std::max(count - (of_column + of_row), 0.0F), 65535.0F) + 0.5F;
}

template <class F>
HWY_INLINE void subtract_row(F&& of_columns, float of_row, int width, std::uint16_t* counts) {
  const I32 d;
  const hn::Rebind<float, I32> df;
  const hn::Rebind<std::uint16_t, I32> d16;
  int x = 0;
  for (; x + kLanes <= width; x += kLanes) {
    const auto before = hn::ConvertTo(df, hn::PromoteTo(d, hn::LoadU(d16, counts + x)));
    const auto value = before - (of_columns(df, x) + hn::Set(df, of_row));
    const auto clamped = hn::Min(hn::Max(value, hn::Zero(df)), hn::Set(df, 65535.0F));
    const auto rounded = hn::ConvertTo(d, clamped + hn::Set(df, 0.5F));
    hn::StoreU(hn::DemoteTo(d16, rounded), d16, counts + x);
  }
  const hn::CappedTag<float, 1> single;
  for (; x < width; ++x) {
    const float value = less_offsets(counts[x], hn::GetLane(of_columns(single, x)), of_row);
    counts[x] = static_cast<std::uint16_t>(value);
  }
}

void subtract_offsets_row(const float* of_columns, float of_row, int width, std::uint16_t* counts) {
  subtract_row([&](auto d, int x) { return hn::LoadU(d, of_columns + x); }, of_row, width, counts);
}

void subtract_offset_row(float of_row, int width, std::uint16_t* counts) {
  subtract_row([](auto d, int) { return hn::Zero(d); }, of_row, width, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(square_row);
HWY_EXPORT(binomial_row);
HWY_EXPORT(clamped_difference_row);
HWY_EXPORT(slide_row);
HWY_EXPORT(mark_beyond_row);
HWY_EXPORT(mark_gradients_row);
HWY_EXPORT(reach_row);
HWY_EXPORT(subtract_offsets_row);
HWY_EXPORT(subtract_offset_row);

void square_row(const std::uint16_t* upper, const std::uint16_t* lower,
                const std::int32_t* of_columns, std::int32_t of_row, int count,
                std::int32_t* sums) {
  THERMEDGE_SIMD_DISPATCH(square_row)(upper, lower, of_columns, of_row, count, sums);
}

void binomial_row(const std::int32_t* centre, std::ptrdiff_t step, int count, std::int32_t* out) {
  THERMEDGE_SIMD_DISPATCH(binomial_row)(centre, step, count, out);
}

void clamped_difference_row(const std::int32_t* ahead, const std::int32_t* behind,
                            std::int32_t most, int count, std::int32_t* out) {
  THERMEDGE_SIMD_DISPATCH(clamped_difference_row)(ahead, behind, most, count, out);
}

void slide_row(const std::int32_t* before, const std::int32_t* added, const std::int32_t* dropped,
               int count, std::int32_t* out) {
  THERMEDGE_SIMD_DISPATCH(slide_row)(before, added, dropped, count, out);
}

void mark_beyond_row(const std::int32_t* values, std::int32_t limit, int count,
                     std::uint8_t* marks) {
  THERMEDGE_SIMD_DISPATCH(mark_beyond_row)(values, limit, count, marks);
}

void mark_gradients_row(const std::int32_t* centre, std::ptrdiff_t stride, std::int32_t limit,
                        int count, std::uint8_t* upright, std::uint8_t* level) {
  THERMEDGE_SIMD_DISPATCH(mark_gradients_row)(centre, stride, limit, count, upright, level);
}

void reach_row(const std::uint8_t* marks, int count, std::uint16_t* reach) {
  THERMEDGE_SIMD_DISPATCH(reach_row)(marks, count, reach);
}

void subtract_offsets_row(const float* of_columns, float of_row, int width, std::uint16_t* counts) {
  THERMEDGE_SIMD_DISPATCH(subtract_offsets_row)(of_columns, of_row, width, counts);
}

void subtract_offset_row(float of_row, int width, std::uint16_t* counts) {
  THERMEDGE_SIMD_DISPATCH(subtract_offset_row)(of_row, width, counts);
}

}  // namespace thermedge::detail
#endif
