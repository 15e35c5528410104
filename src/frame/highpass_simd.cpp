#include "highpass_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "highpass_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
V second_difference(V first, V middle, V last) {
  return first + last - (middle + middle);
}
template <class V>
V smoothed(V first, V middle, V last) {
  return first + last + (middle + middle);
}

void highpass_row(const CountRows& rows, int width, std::uint16_t* residual, std::uint16_t* slope) {
  const hn::ScalableTag<std::int32_t> d;
  const hn::Rebind<std::uint16_t, decltype(d)> d16;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto load = [&](const std::uint16_t* counts) {
    return hn::PromoteTo(d, hn::LoadU(d16, counts));
  };
  for (int x = 0; x < width - 2; x += lanes) {
    const auto north_west = load(rows.above + x);
    const auto north = load(rows.above + x + 1);
    const auto north_east = load(rows.above + x + 2);
    const auto west = load(rows.row + x);
    const auto centre = load(rows.row + x + 1);
    const auto east = load(rows.row + x + 2);
    const auto south_west = load(rows.below + x);
    const auto south = load(rows.below + x + 1);
    const auto south_east = load(rows.below + x + 2);
    const auto high = second_difference(second_difference(north_west, west, south_west),
                                        second_difference(north, centre, south),
                                        second_difference(north_east, east, south_east));
    const auto gx = smoothed(north_east - north_west, east - west, south_east - south_west);
    const auto gy = smoothed(south_west - north_west, south - north, south_east - north_east);
    hn::StoreU(hn::DemoteTo(d16, hn::Abs(high)), d16, residual + x);
    hn::StoreU(hn::DemoteTo(d16, hn::Abs(gx) + hn::Abs(gy)), d16, slope + x);
  }
}

// Medians of one vector of columns: the smallest values that at most half of the rows exceed.
// `count_above(limit)` are the rows with a value > limit, per lane.
template <class D, class F>
hn::Vec<D> integer_medians(D d, int rows, F&& count_above) {
  constexpr int kBits = 18;  // of the magnitude of the values
  const auto half = hn::Set(d, rows / 2);
  auto low = hn::Set(d, -(1 << kBits));
  auto high = hn::Set(d, 1 << kBits);
  for (int halvings = 0; halvings <= kBits + 1; ++halvings) {
    const auto middle = hn::ShiftRight<1>(low + high);
    const auto is_higher = count_above(middle) > half;
    low = hn::IfThenElse(is_higher, middle + hn::Set(d, 1), low);
    high = hn::IfThenElse(is_higher, high, middle);
  }
  return high;
}

void column_medians(ImageView<const std::int32_t> table, float* medians) {
  const hn::ScalableTag<std::int32_t> d;
  const hn::Rebind<float, decltype(d)> df;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  for (int x = 0; x < table.width(); x += lanes) {
    const auto count_above = [&](auto limit) {
      auto count = hn::Zero(d);
      for (int y = 0; y < table.height(); ++y) {
        const auto is_above = hn::LoadU(d, table.row(y) + x) > limit;
        count = count - hn::VecFromMask(d, is_above);  // true is -1
      }
      return count;
    };
    const auto median = integer_medians(d, table.height(), count_above);
    const auto from = hn::ConvertTo(df, count_above(median - hn::Set(d, 1)));
    const auto above = hn::ConvertTo(df, count_above(median));
    const auto half = hn::Set(df, static_cast<float>(table.height()) * 0.5F);
    const auto within = (from - half) / (from - above);
    hn::StoreU(hn::ConvertTo(df, median) - hn::Set(df, 0.5F) + within, df, medians + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(highpass_row);
HWY_EXPORT(column_medians);

void highpass_row(const CountRows& rows, int width, std::uint16_t* residual, std::uint16_t* slope) {
  THERMEDGE_SIMD_DISPATCH(highpass_row)(rows, width, residual, slope);
}

void column_medians(ImageView<const std::int32_t> table, float* medians) {
  THERMEDGE_SIMD_DISPATCH(column_medians)(table, medians);
}

}  // namespace thermedge::detail
#endif
