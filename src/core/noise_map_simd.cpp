#include "noise_map_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise_map_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using One = hn::CappedTag<double, 1>;

// task(d, i, levels) for whole vectors, then for single pixels; `d` is a tag of floats.
template <class F>
HWY_INLINE void for_each_level(const LevelRun& run, F&& task) {
  const auto look_at = [&](auto wide, int i) HWY_ATTR {
    const hn::Rebind<float, decltype(wide)> d;
    const auto share = hn::LoadU(wide, run.shares + i);
    const auto level = hn::Set(wide, run.left) + share * hn::Set(wide, run.step);
    task(d, i, hn::DemoteTo(d, level));
  };
  const auto lanes = static_cast<int>(hn::Lanes(Doubles()));
  int i = 0;
  for (; i + lanes <= run.count; i += lanes) {
    look_at(Doubles(), i);
  }
  for (; i < run.count; ++i) {
    look_at(One(), i);
  }
}

void level_run(const LevelRun& run, float* out) {
  for_each_level(run, [&](auto d, int i, auto level) HWY_ATTR { hn::StoreU(level, d, out + i); });
}

void even_out_run(const LevelRun& run, const float* in, float middle, float offset, float* out) {
  for_each_level(run, [&](auto d, int i, auto level) HWY_ATTR {
    const auto distance = hn::LoadU(d, in + i) - hn::Set(d, middle);
    hn::StoreU(hn::Set(d, offset) + distance / level, d, out + i);
  });
}

void undo_even_out_run(const LevelRun& run, float middle, float* values) {
  for_each_level(run, [&](auto d, int i, auto level) HWY_ATTR {
    hn::StoreU(hn::LoadU(d, values + i) * level + hn::Set(d, middle), d, values + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(level_run);
HWY_EXPORT(even_out_run);
HWY_EXPORT(undo_even_out_run);

void level_run(const LevelRun& run, float* out) { THERMEDGE_SIMD_DISPATCH(level_run)(run, out); }

void even_out_run(const LevelRun& run, const float* in, float middle, float offset, float* out) {
  THERMEDGE_SIMD_DISPATCH(even_out_run)(run, in, middle, offset, out);
}

void undo_even_out_run(const LevelRun& run, float middle, float* values) {
  THERMEDGE_SIMD_DISPATCH(undo_even_out_run)(run, middle, values);
}

}  // namespace thermedge::detail
#endif
