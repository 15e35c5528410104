#include "outliers_simd.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "outliers_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// By how much the pixels 1 .. lanes of the middle row exceed `limit`; 0 where they do not.
template <class D>
hn::Vec<D> excess_over_neighbours(D d, const CountRows& rows, hn::Vec<D> limit) {
  auto largest = hn::Zero(d);
  auto second_largest = hn::Zero(d);
  auto smallest = hn::Set(d, 0xFFFF);
  auto second_smallest = hn::Set(d, 0xFFFF);
  const auto take = [&](const std::uint16_t* counts) {
    const auto value = hn::LoadU(d, counts);
    second_largest = hn::Max(second_largest, hn::Min(largest, value));
    largest = hn::Max(largest, value);
    second_smallest = hn::Min(second_smallest, hn::Max(smallest, value));
    smallest = hn::Min(smallest, value);
  };
  for (const std::uint16_t* row : {rows.above, rows.below}) {
    take(row);
    take(row + 1);
    take(row + 2);
  }
  take(rows.row);
  take(rows.row + 2);
  const auto centre = hn::LoadU(d, rows.row + 1);
  const auto above = hn::SaturatedSub(centre, second_largest);
  const auto below = hn::SaturatedSub(second_smallest, centre);
  return hn::SaturatedSub(hn::Max(above, below), limit);
}

// Looks at `lanes` pixels from column `first`; those before column `next` are known already.
template <class D>
void append_from_vector(D d, const CountRows& rows, int first, int next, int y, int limit,
                        std::vector<BadPixel>& outliers) {
  const CountRows here{rows.above + first - 1, rows.row + first - 1, rows.below + first - 1};
  const auto limits = hn::Set(d, static_cast<std::uint16_t>(limit));
  const auto excess = excess_over_neighbours(d, here, limits);
  if (hn::AllTrue(d, excess == hn::Zero(d))) {
    return;
  }
  std::uint16_t values[HWY_MAX_BYTES / sizeof(std::uint16_t)];
  hn::StoreU(excess, d, values);
  for (int x = std::max(first, next); x < first + static_cast<int>(hn::Lanes(d)); ++x) {
    if (values[x - first] != 0) {
      outliers.push_back({x, y});
    }
  }
}

// A row of fewer pixels than a vector: the same on copies with room after them.
template <class D>
void append_from_short_row(D d, const CountRows& rows, int width, int y, int limit,
                           std::vector<BadPixel>& outliers) {
  constexpr int kRoom = HWY_MAX_BYTES / sizeof(std::uint16_t) + 2;
  std::uint16_t copies[3][kRoom] = {};
  std::copy_n(rows.above, width, copies[0]);
  std::copy_n(rows.row, width, copies[1]);
  std::copy_n(rows.below, width, copies[2]);
  append_from_vector(d, {copies[0], copies[1], copies[2]}, 1, 1, y, limit, outliers);
  while (!outliers.empty() && outliers.back().y == y && outliers.back().x > width - 2) {
    outliers.pop_back();
  }
}

void append_outliers(const CountRows& rows, int width, int y, int limit,
                     std::vector<BadPixel>& outliers) {
  const hn::ScalableTag<std::uint16_t> d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  if (width - 2 < lanes) {
    append_from_short_row(d, rows, width, y, limit, outliers);
    return;
  }
  int x = 1;
  for (; x + lanes <= width - 1; x += lanes) {
    append_from_vector(d, rows, x, x, y, limit, outliers);
  }
  append_from_vector(d, rows, width - 1 - lanes, x, y, limit, outliers);
}

// Of the blocks whose left upper pixels are the lanes from column `first`: by how much their least
// pixel exceeds one neighbour on each side, or their largest one falls short of these, beyond
// `limit`; 0 where neither does.
template <class D>
hn::Vec<D> block_excess(D d, const std::array<const std::uint16_t*, 4>& rows, int first,
                        hn::Vec<D> limit) {
  const auto at = [&](std::size_t row, int step) { return hn::LoadU(d, rows[row] + first + step); };
  const auto a = at(1, 0);
  const auto b = at(1, 1);
  const auto c = at(2, 0);
  const auto e = at(2, 1);
  const auto above = at(0, 0);
  const auto below = at(3, 1);
  const auto left = at(2, -1);
  const auto right = at(1, 2);
  const auto least = hn::Min(hn::Min(a, b), hn::Min(c, e));
  const auto largest = hn::Max(hn::Max(a, b), hn::Max(c, e));
  const auto high = hn::Max(hn::Max(above, below), hn::Max(left, right));
  const auto low = hn::Min(hn::Min(above, below), hn::Min(left, right));
  const auto excess = hn::Max(hn::SaturatedSub(least, high), hn::SaturatedSub(low, largest));
  return hn::SaturatedSub(excess, limit);
}

bool any_block_stands_out(const std::array<const std::uint16_t*, 4>& rows, int width, int limit) {
  const hn::ScalableTag<std::uint16_t> d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const int end = width - 2;  // of the left columns that have all neighbours
  if (end - 1 < lanes) {
    return true;  // a short row is looked at pixel by pixel
  }
  const auto limits = hn::Set(d, static_cast<std::uint16_t>(limit));
  auto any = hn::Zero(d);
  for (int x = 1; x + lanes <= end; x += lanes) {
    any = hn::Or(any, block_excess(d, rows, x, limits));
  }
  any = hn::Or(any, block_excess(d, rows, end - lanes, limits));
  return !hn::AllTrue(d, any == hn::Zero(d));
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(append_outliers);
HWY_EXPORT(any_block_stands_out);

void append_outliers(const CountRows& rows, int width, int y, int limit,
                     std::vector<BadPixel>& outliers) {
  THERMEDGE_SIMD_DISPATCH(append_outliers)(rows, width, y, limit, outliers);
}

bool any_block_stands_out(const std::array<const std::uint16_t*, 4>& rows, int width, int limit) {
  return THERMEDGE_SIMD_DISPATCH(any_block_stands_out)(rows, width, limit);
}

}  // namespace thermedge::detail
#endif
