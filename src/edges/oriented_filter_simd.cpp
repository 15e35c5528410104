#include "oriented_filter_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "oriented_filter_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::CappedTag<float, kFilterSlack>;
using Floats = hn::Vec<F32>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(F32()));

void odd_filter_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                    int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    auto sum = hn::Zero(d);
    for (int k = 1; k <= radius; ++k) {
      const auto difference =
          hn::LoadU(d, centre + x + k * step) - hn::LoadU(d, centre + x - k * step);
      sum = sum + hn::Set(d, weights[k]) * difference;
    }
    hn::StoreU(sum, d, out + x);
  }
}

void magnitude_row(const float* gx, const float* gy, int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    const auto x_part = hn::LoadU(d, gx + x);
    const auto y_part = hn::LoadU(d, gy + x);
    hn::StoreU(hn::Sqrt(x_part * x_part + y_part * y_part), d, out + x);
  }
}

void project_row(const float* gx, const float* gy, float a, float b, int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    hn::StoreU(hn::Set(d, a) * hn::LoadU(d, gx + x) + hn::Set(d, b) * hn::LoadU(d, gy + x), d,
               out + x);
  }
}

void keep_stronger_row(const float* centre, const std::ptrdiff_t* offsets, const float* weights,
                       int radius, int index, int reverse, int width, float* response,
                       std::int32_t* direction) {
  const F32 d;
  const hn::RebindToSigned<F32> di;
  const auto self = hn::Set(di, index);
  const auto reversed = hn::Set(di, index + reverse);
  for (int x = 0; x < width; x += kLanes) {
    auto sum = hn::Set(d, weights[0]) * hn::LoadU(d, centre + x);
    for (int k = 1; k <= radius; ++k) {
      const auto both =
          hn::LoadU(d, centre + x + offsets[k]) + hn::LoadU(d, centre + x - offsets[k]);
      sum = sum + hn::Set(d, weights[k]) * both;
    }
    const auto size = hn::Abs(sum);
    const auto signed_self = hn::IfThenElse(hn::RebindMask(di, sum < hn::Zero(d)), reversed, self);
    if (index == 0) {
      hn::StoreU(size, d, response + x);
      hn::StoreU(signed_self, di, direction + x);
      continue;
    }
    const auto before = hn::LoadU(d, response + x);
    const auto is_stronger = hn::RebindMask(di, size > before);
    hn::StoreU(hn::Max(size, before), d, response + x);
    hn::StoreU(hn::IfThenElse(is_stronger, signed_self, hn::LoadU(di, direction + x)), di,
               direction + x);
  }
}

using I32 = hn::RebindToSigned<F32>;
using Ints = hn::Vec<I32>;

// By the direction, of 0 .. 11.
HWY_INLINE Floats share_of(Ints direction, const DiagonalShares& shares) {
  const F32 d;
  const I32 di;
  const auto six = hn::Set(di, 6);
  const auto folded = hn::Min(direction, hn::Abs(direction - six));  // 0 .. 6
  const auto off_axis = hn::Min(folded, six - folded);
  const auto is = [&](int steps) { return hn::RebindMask(d, off_axis == hn::Set(di, steps)); };
  return hn::IfThenElse(
      is(0), hn::Set(d, shares[0]),
      hn::IfThenElse(is(1), hn::Set(d, shares[1]),
                     hn::IfThenElse(is(2), hn::Set(d, shares[2]), hn::Set(d, shares[3]))));
}

int find_ridges_row(const float* response, std::ptrdiff_t stride, const std::int32_t* direction,
                    const DiagonalShares& shares, float low, int count, std::int32_t* places) {
  const F32 d;
  const I32 di;
  const auto half_turn = hn::Set(di, kEdgeOrientations);
  int found = 0;
  for (int x = 0; x < count; x += kLanes) {
    const auto any = hn::LoadU(di, direction + x);
    const auto folded = hn::IfThenElse(any < half_turn, any, any - half_turn);
    const auto share = share_of(folded, shares);
    const auto is_below = [&](int limit) { return hn::RebindMask(d, folded < hn::Set(di, limit)); };
    const auto at = [&](int dx, int dy) { return hn::LoadU(d, response + x + dx + dy * stride); };
    // Ahead (sign 1) or behind (-1): the neighbour at a side, and from it towards the diagonal one.
    const auto across = [&](int sign) {
      const auto side = hn::IfThenElse(is_below(3), at(0, sign),
                                       hn::IfThenElse(is_below(10), at(-sign, 0), at(0, -sign)));
      const auto diagonal = hn::IfThenElse(is_below(7), at(-sign, sign), at(-sign, -sign));
      return side + share * (diagonal - side);
    };
    const auto centre = at(0, 0);
    const auto is_ridge =
        hn::And(centre > hn::Set(d, low), hn::And(centre >= across(1), centre > across(-1)));
    const auto xs = hn::Iota(di, x);
    const auto is_found = hn::And(hn::RebindMask(di, is_ridge), xs < hn::Set(di, count));
    hn::StoreU(hn::Compress(xs, is_found), di, places + found);
    found += static_cast<int>(hn::CountTrue(di, is_found));
  }
  return found;
}

void suppressed_responses_at(const float* response, const std::int32_t* direction,
                             const std::int32_t* offsets, int sides, const std::int32_t* places,
                             int count, float* out) {
  const F32 d;
  const I32 di;
  for (int i = 0; i < count; i += kLanes) {
    const auto place = hn::LoadU(di, places + i);
    const auto own = hn::GatherIndex(di, direction, place);
    const auto at = [&](Ints side) {
      const auto turn = hn::Abs(hn::GatherIndex(di, direction, side) - own);
      const auto differs = hn::And(turn > hn::Set(di, kLargestTurn),
                                   turn < hn::Set(di, kEdgeDirections - kLargestTurn));
      return hn::IfThenElse(hn::RebindMask(d, differs), hn::Zero(d),
                            hn::GatherIndex(d, response, side));
    };
    auto least = hn::Zero(d);
    for (int side = 0; side < sides; ++side) {
      const auto offset = hn::GatherIndex(di, offsets + kEdgeDirections * side, own);
      const auto both = at(place + offset) + at(place - offset);
      least = side == 0 ? both : hn::Min(least, both);
    }
    hn::StoreU(hn::GatherIndex(d, response, place) - hn::Set(d, 0.5F) * least, d, out + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(odd_filter_row);
HWY_EXPORT(magnitude_row);
HWY_EXPORT(project_row);
HWY_EXPORT(keep_stronger_row);
HWY_EXPORT(find_ridges_row);
HWY_EXPORT(suppressed_responses_at);

void odd_filter_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                    int width, float* out) {
  THERMEDGE_SIMD_DISPATCH(odd_filter_row)(centre, step, weights, radius, width, out);
}

void magnitude_row(const float* gx, const float* gy, int width, float* out) {
  THERMEDGE_SIMD_DISPATCH(magnitude_row)(gx, gy, width, out);
}

void project_row(const float* gx, const float* gy, float a, float b, int width, float* out) {
  THERMEDGE_SIMD_DISPATCH(project_row)(gx, gy, a, b, width, out);
}

void keep_stronger_row(const float* centre, const std::ptrdiff_t* offsets, const float* weights,
                       int radius, int index, int reverse, int width, float* response,
                       std::int32_t* direction) {
  THERMEDGE_SIMD_DISPATCH(keep_stronger_row)
  (centre, offsets, weights, radius, index, reverse, width, response, direction);
}

int find_ridges_row(const float* response, std::ptrdiff_t stride, const std::int32_t* direction,
                    const DiagonalShares& shares, float low, int count, std::int32_t* places) {
  return THERMEDGE_SIMD_DISPATCH(find_ridges_row)(response, stride, direction, shares, low, count,
                                                  places);
}

void suppressed_responses_at(const float* response, const std::int32_t* direction,
                             const std::int32_t* offsets, int sides, const std::int32_t* places,
                             int count, float* out) {
  THERMEDGE_SIMD_DISPATCH(suppressed_responses_at)
  (response, direction, offsets, sides, places, count, out);
}

}  // namespace thermedge::detail
#endif
