#include "edgel_runs_simd.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "edgel_runs_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Blocks are filled and read up to a vector past their last element.
constexpr int kBlock = kMostEdgels + 8;
using Doubles = hn::CappedTag<double, 8>;
using One = hn::CappedTag<double, 1>;

// Where a run of points lies between the pixels of a frame.
struct Samples {
  alignas(64) std::array<double, kBlock> fx, fy;               // of the way to the next pixel
  alignas(64) std::array<double, kBlock> inside;               // 0, or NaN outside
  alignas(64) std::array<std::int32_t, kBlock> place;          // of the upper left pixel; 0 outside
  alignas(64) std::array<std::uint32_t, kBlock> upper, lower;  // two pixels each
};

// Task(d, i) for whole vectors, then for single elements.
template <class F>
HWY_INLINE void for_each_vector(int count, F&& task) {
  const Doubles d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  int i = 0;
  for (; i + lanes <= count; i += lanes) {
    task(d, i);
  }
  for (; i < count; ++i) {
    task(One(), i);
  }
}

template <class D>
HWY_INLINE hn::Vec<D> load_floats(D d, const float* values) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), values));
}

template <class D>
HWY_INLINE void place_vector(D d, ImageView<const std::uint16_t> frame, const EdgelRun& edgels,
                             double distance_px, int i, Samples& samples) {
  const hn::Rebind<std::int32_t, D> di;
  const auto distance = hn::Set(d, distance_px);
  const double last_x = frame.width() - 1;
  const double last_y = frame.height() - 1;
  const auto x = load_floats(d, edgels.x + i) + distance * load_floats(d, edgels.nx + i);
  const auto y = load_floats(d, edgels.y + i) + distance * load_floats(d, edgels.ny + i);
  const auto inside = hn::And(hn::And(x >= hn::Zero(d), y >= hn::Zero(d)),
                              hn::And(x < hn::Set(d, last_x), y < hn::Set(d, last_y)));
  const auto left = hn::DemoteTo(di, hn::IfThenElseZero(inside, x));
  const auto top = hn::DemoteTo(di, hn::IfThenElseZero(inside, y));
  const auto stride = hn::Set(di, static_cast<std::int32_t>(frame.stride()));
  hn::StoreU(top * stride + left, di, samples.place.data() + i);
  hn::StoreU(x - hn::PromoteTo(d, left), d, samples.fx.data() + i);
  hn::StoreU(y - hn::PromoteTo(d, top), d, samples.fy.data() + i);
  const auto nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  hn::StoreU(hn::IfThenElse(inside, hn::Zero(d), nan), d, samples.inside.data() + i);
}

// At `distance_px` along the normals.
HWY_INLINE void take_samples(ImageView<const std::uint16_t> frame, const EdgelRun& edgels,
                             double distance_px, Samples& samples) {
  for_each_vector(edgels.count,
                  [&](auto d, int i) { place_vector(d, frame, edgels, distance_px, i, samples); });
  for (std::size_t i = 0; i < static_cast<std::size_t>(edgels.count); ++i) {
    const std::uint16_t* at = frame.data() + samples.place[i];
    std::memcpy(&samples.upper[i], at, sizeof(samples.upper[i]));
    std::memcpy(&samples.lower[i], at + frame.stride(), sizeof(samples.lower[i]));
  }
}

template <class D>
HWY_INLINE hn::Vec<D> between(D d, const std::uint32_t* pairs, hn::Vec<D> share) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::Rebind<std::uint32_t, D> du;
  const auto pair = hn::LoadU(du, pairs);
  const auto left = hn::PromoteTo(d, hn::BitCast(di, hn::And(pair, hn::Set(du, 0xFFFFU))));
  const auto right = hn::PromoteTo(d, hn::BitCast(di, hn::ShiftRight<16>(pair)));
  return left + share * (right - left);
}

template <class D>
HWY_INLINE hn::Vec<D> bilinear(D d, const Samples& samples, int i) {
  const auto fx = hn::LoadU(d, samples.fx.data() + i);
  const auto upper = between(d, samples.upper.data() + i, fx);
  const auto lower = between(d, samples.lower.data() + i, fx);
  const auto value = upper + hn::LoadU(d, samples.fy.data() + i) * (lower - upper);
  return value + hn::LoadU(d, samples.inside.data() + i);
}

void differences_across(ImageView<const std::uint16_t> frame, const EdgelRun& edgels,
                        double distance_px, double* out) {
  assert(edgels.count <= kMostEdgels);
  if (frame.width() < 2 || frame.height() < 2) {
    std::fill_n(out, edgels.count, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  Samples ahead;
  Samples behind;
  take_samples(frame, edgels, distance_px, ahead);
  take_samples(frame, edgels, -distance_px, behind);
  for_each_vector(edgels.count, [&](auto d, int i) {
    hn::StoreU(bilinear(d, ahead, i) - bilinear(d, behind, i), d, out + i);
  });
}

void tangents(const float* coordinate, int count, double* out) {
  for_each_vector(count, [&](auto d, int i) {
    auto sum = hn::Zero(d);
    for (int k = 1; k <= kTangentReach; ++k) {
      const auto chord = load_floats(d, coordinate + i + k) - load_floats(d, coordinate + i - k);
      sum = sum + hn::Set(d, kTangentWeights[k - 1]) * chord;
    }
    hn::StoreU(sum, d, out + i);
  });
}

void backward_sums(const double* values, const double* weights, int taps, int count, double* out) {
  for_each_vector(count, [&](auto d, int i) {
    auto sum = hn::Zero(d);
    for (int k = taps - 1; k >= 0; --k) {
      sum = sum + hn::Set(d, weights[k]) * hn::LoadU(d, values + i + k);
    }
    hn::StoreU(sum, d, out + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(differences_across);
HWY_EXPORT(tangents);
HWY_EXPORT(backward_sums);

void differences_across(ImageView<const std::uint16_t> frame, const EdgelRun& edgels,
                        double distance_px, double* out) {
  THERMEDGE_SIMD_DISPATCH(differences_across)(frame, edgels, distance_px, out);
}

void tangents(const float* coordinate, int count, double* out) {
  THERMEDGE_SIMD_DISPATCH(tangents)(coordinate, count, out);
}

void backward_sums(const double* values, const double* weights, int taps, int count, double* out) {
  THERMEDGE_SIMD_DISPATCH(backward_sums)(values, weights, taps, count, out);
}

}  // namespace thermedge::detail
#endif
