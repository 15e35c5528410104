#include "bm3d_match_simd.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bm3d_match_simd.cpp"
#include "simd_config.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Outside the target namespaces: one definition for all of them.
#ifndef THERMEDGE_SIMD_BM3D_MATCH_ONCE
#define THERMEDGE_SIMD_BM3D_MATCH_ONCE
namespace thermedge::detail {

inline constexpr int kWidestLanes = 32;  // of any target
inline constexpr int kCellPixels = kCellPx * kCellPx;
inline constexpr std::int16_t kNoMatch = 0x7ffe;  // beyond every distance
inline constexpr std::uint16_t kFarthest = 0x7ffd;

// Levels in a unit of the noise: noise alone makes a sum of 64 absolute differences of about 290,
// so good matches stay far below the largest distance.
inline constexpr float kLevelsPerSigma = 4;

inline int rounded_up(int value, int multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

struct Search {
  [[nodiscard]] int last_x() const { return guide.width() - kBlockPx; }
  [[nodiscard]] int last_y() const { return guide.height() - kBlockPx; }
  // Cells from x to the last reference block.
  [[nodiscard]] int lanes() const { return row.columns.back() + 1; }

  const MatchGuide& guide;
  const SearchPattern& pattern;
  const ReferenceRow& row;
};

}  // namespace thermedge::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U16 = hn::CappedTag<std::uint16_t, kWidestLanes>;
using I16 = hn::RebindToSigned<U16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(U16()));

void quantise_row(const float* values, int columns, std::int16_t* phases, std::ptrdiff_t stride) {
  const hn::CappedTag<float, kWidestLanes / 2> d;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  const auto scale = hn::Set(d, kLevelsPerSigma);
  const auto largest = hn::Set(d, 1.0e9F);  // an integer of 32 bits holds it
  for (int x = 0; x < columns; x += static_cast<int>(hn::Lanes(d))) {
    hn::Vec<decltype(d)> phase[kCellPx];
    hn::LoadInterleaved4(d, values + kCellPx * x, phase[0], phase[1], phase[2], phase[3]);
    for (int p = 0; p < kCellPx; ++p) {
      const auto level = hn::Max(hn::Min(phase[p] * scale, largest), hn::Neg(largest));
      // The low half of the integer, as a signed number that nothing saturates.
      const auto low_half = hn::ShiftRight<16>(hn::ShiftLeft<16>(hn::NearestInt(level)));
      hn::StoreU(hn::DemoteTo(d16, low_half), d16, phases + p * stride + x);
    }
  }
}

// Which lanes are set, as bits.
template <class Mask>
HWY_INLINE std::uint64_t lanes_of(Mask mask) {
  HWY_ALIGN std::uint8_t bits[8] = {};
  hn::StoreMaskBits(I16(), mask, bits);
  std::uint64_t lanes = 0;
  hwy::CopyBytes<sizeof(lanes)>(bits, &lanes);
  return lanes;
}

// Sums of absolute differences over the cells of the reference blocks that begin at row `y`, for
// all candidates of one dy (of which there may be none).
void sum_cells(const Search& search, int y, int dy, ImageView<std::uint16_t> cells) {
  const U16 d;
  const I16 di;
  const auto candidates = search.pattern.row(dy);
  const ImageView<const std::int16_t> phases = search.guide.phases();
  const std::ptrdiff_t stride = phases.stride();
  const auto offset_of = [&](int x) { return (x & (kCellPx - 1)) * stride + (x >> 2); };
  const int x0 = search.row.x;
  for (int lane = 0; lane <= search.lanes(); lane += kLanes) {
    const int column = search.guide.margin() + lane;
    const std::int16_t* reference = phases.row(y * kCellPx) + column;
    const std::int16_t* candidate = phases.row((y + dy) * kCellPx) + column;
    hn::Vec<I16> pixels[kCellPixels];
    HWY_UNROLL(16)
    for (int i = 0; i < kCellPixels; ++i) {
      pixels[i] =
          hn::LoadU(di, reference + (i / kCellPx) * kCellPx * stride + offset_of(x0 + i % kCellPx));
    }
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      std::ptrdiff_t offsets[kCellPx];
      for (int i = 0; i < kCellPx; ++i) {
        offsets[i] = offset_of(x0 + candidates[k].dx + i);
      }
      auto sum = hn::Zero(d);
      HWY_UNROLL(16)
      for (int i = 0; i < kCellPixels; ++i) {
        const auto* other = candidate + (i / kCellPx) * kCellPx * stride + offsets[i % kCellPx];
        const auto difference = hn::Abs(hn::LoadU(di, other) - pixels[i]);
        sum = hn::SaturatedAdd(sum, hn::BitCast(d, difference));
      }
      hn::Store(sum, d, cells.row(static_cast<int>(k)) + lane);
    }
  }
}

// A cell and the one right of it.
HWY_INLINE hn::Vec<U16> sum_of_two(const std::uint16_t* cells) {
  return hn::SaturatedAdd(hn::Load(U16(), cells), hn::LoadU(U16(), cells + 1));
}

// Sums over the upper halves of the blocks.
void begin_pairs(const Search& search, MatchScratch& scratch) {
  const SearchPattern& pattern = search.pattern;
  for (int dy = -pattern.radius_px(); dy <= pattern.radius_px(); ++dy) {
    const int y = search.row.y + dy;
    if (y < 0 || y > search.last_y()) {
      continue;
    }
    const auto candidates = pattern.row(dy);
    sum_cells(search, search.row.y, dy, scratch.cells);
    for (int k = 0; k < static_cast<int>(candidates.size()); ++k) {
      for (int x = 0; x < search.lanes(); x += kLanes) {
        hn::Store(sum_of_two(scratch.cells.row(k) + x), U16(),
                  scratch.pairs.row(pattern.row_begin(dy) + k) + x);
      }
    }
  }
}

// Distances in the lanes where the candidate lies in the frame.
HWY_INLINE hn::Vec<I16> distances_of(const Search& search, SearchPattern::Candidate candidate,
                                     int x, hn::Vec<U16> sums) {
  const U16 d;
  const I16 di;
  if (candidate.dx == 0 && candidate.dy == 0) {
    return hn::Zero(di);
  }
  const auto distances =
      hn::BitCast(di, hn::Min(hn::SaturatedAdd(sums, hn::Set(d, 1)), hn::Set(d, kFarthest)));
  const int left = search.row.x + kCellPx * x + candidate.dx;  // of the first lane
  const int right = left + kCellPx * (kLanes - 1);
  if (left >= 0 && right <= search.last_x()) {
    return distances;
  }
  const auto lanes = hn::Iota(di, 0);
  const int outside_left = left < 0 ? (-left + kCellPx - 1) / kCellPx : 0;
  const int inside = search.last_x() < left ? 0 : (search.last_x() - left) / kCellPx + 1;
  const auto too_far = hn::Or(lanes < hn::Set(di, static_cast<std::int16_t>(outside_left)),
                              hn::Not(lanes < hn::Set(di, static_cast<std::int16_t>(inside))));
  return hn::IfThenElse(too_far, hn::Set(di, kNoMatch), distances);
}

// Of each class the least distance and the first candidate that has it; and the sums over the
// lower halves of all blocks.
void find_nearest(const Search& search, MatchScratch& scratch) {
  const U16 d;
  const I16 di;
  const SearchPattern& pattern = search.pattern;
  fill_pixels(scratch.least.view(), kNoMatch);
  for (int dy = -pattern.radius_px(); dy <= pattern.radius_px(); ++dy) {
    const int y = search.row.y + dy;
    if (y < -kCellPx || y > search.last_y()) {
      continue;
    }
    const auto candidates = pattern.row(dy);
    sum_cells(search, search.row.y + kCellPx, dy, scratch.cells);
    for (int k = 0; k < static_cast<int>(candidates.size()); ++k) {
      const SearchPattern::Candidate candidate = candidates[static_cast<std::size_t>(k)];
      const int index = pattern.row_begin(dy) + k;
      const std::uint16_t* cells = scratch.cells.row(k);
      std::uint16_t* pairs = scratch.pairs.row(index);
      std::int16_t* least = scratch.least.row(candidate.neighbours);
      std::int16_t* nearest = scratch.nearest.row(candidate.neighbours);
      for (int x = 0; x < search.lanes(); x += kLanes) {
        const auto lower = sum_of_two(cells + x);
        if (y >= 0) {
          const auto sums = hn::SaturatedAdd(hn::Load(d, pairs + x), lower);
          const auto distance = distances_of(search, candidate, x, sums);
          const auto before = hn::Load(di, least + x);
          const auto is_less = distance < before;
          const auto self = hn::Set(di, static_cast<std::int16_t>(index));
          hn::Store(hn::IfThenElse(is_less, self, hn::Load(di, nearest + x)), di, nearest + x);
          hn::Store(hn::Min(distance, before), di, least + x);
        }
        hn::Store(lower, d, pairs + x);
      }
    }
  }
}

// For each lane, how many classes have a least distance up to `limit`.
HWY_INLINE hn::Vec<I16> count_within(const MatchScratch& scratch, int x, hn::Vec<I16> limit) {
  const I16 d;
  auto count = hn::Zero(d);
  for (int i = 0; i < scratch.least.height(); ++i) {
    const auto beyond = hn::Load(d, scratch.least.row(i) + x) > limit;
    count = count + hn::IfThenZeroElse(beyond, hn::Set(d, 1));
  }
  return count;
}

// For each lane a distance that at least `groups` classes do not exceed: classes are dealt out to
// as many groups, whose smallest distances are these. kNoMatch where there are fewer.
HWY_INLINE hn::Vec<I16> bound_of(const MatchScratch& scratch, int x, int groups) {
  const I16 d;
  auto bound = hn::Zero(d);
  for (int group = 0; group < groups; ++group) {
    auto least = hn::Set(d, kNoMatch);
    for (int i = group; i < scratch.least.height(); i += groups) {
      least = hn::Min(least, hn::Load(d, scratch.least.row(i) + x));
    }
    bound = hn::Max(bound, least);
  }
  return bound;
}

// The largest power of two up to `largest_group` for which the lane has classes.
void group_sizes(const MatchScratch& scratch, int x, int largest_group, std::int16_t* sizes) {
  const I16 d;
  hn::Store(count_within(scratch, x, hn::Set(d, kFarthest)), d, sizes);
  std::transform(sizes, sizes + kLanes, sizes, [&](std::int16_t count) {
    const auto most = static_cast<unsigned>(std::clamp<int>(count, 1, largest_group));
    return static_cast<std::int16_t>(std::bit_floor(most));
  });
}

// Lists for each of the lanes `used` the classes of the sizes[lane] least distances.
void take_nearest(int x, int largest_group, const std::int16_t* sizes, std::uint64_t used,
                  MatchScratch& scratch) {
  const I16 d;
  const auto one = hn::Set(d, 1);
  const auto wanted = hn::Load(d, sizes);
  // Bisection: no more than `wanted` classes but too few lie within `low`, enough within `high`.
  auto low = hn::Set(d, -1);
  auto high = bound_of(scratch, x, largest_group);
  auto ties = wanted;  // classes at `high` to be taken
  while (!hn::AllFalse(d, high - low > one)) {
    const auto middle = low + hn::ShiftRight<1>(high - low);
    const auto count = count_within(scratch, x, middle);
    const auto too_few = wanted > count;
    low = hn::IfThenElse(too_few, middle, low);
    ties = hn::IfThenElse(too_few, wanted - count, ties);
    high = hn::IfThenElse(too_few, high, middle);
    // Just enough: no need to go on.
    const auto found = count == wanted;
    low = hn::IfThenElse(found, middle, low);
    ties = hn::IfThenElse(found, wanted, ties);
  }
  int counts[kLanes] = {};
  for (int i = 0; i < scratch.least.height(); ++i) {
    const auto distance = hn::Load(d, scratch.least.row(i) + x);
    const auto tied = hn::And(distance == high, ties > hn::Zero(d));
    ties = ties - hn::IfThenElseZero(tied, one);
    std::uint64_t lanes = lanes_of(hn::Or(distance < high, tied)) & used;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes));
      scratch.taken(counts[lane]++, lane) = static_cast<std::int16_t>(i);
    }
  }
}

void match_row(const Search& search, int largest_group, MatchScratch& scratch,
               std::span<BlockGroup> groups) {
  find_nearest(search, scratch);
  const std::span<const int> columns = search.row.columns;
  std::size_t i = 0;
  for (int x = 0; x < search.lanes(); x += kLanes) {
    std::uint64_t used = 0;
    for (std::size_t k = i; k < columns.size() && columns[k] < x + kLanes; ++k) {
      used |= std::uint64_t{1} << (columns[k] - x);
    }
    HWY_ALIGN std::int16_t sizes[kLanes];
    group_sizes(scratch, x, largest_group, sizes);
    take_nearest(x, largest_group, sizes, used, scratch);
    for (; i < columns.size() && columns[i] < x + kLanes; ++i) {
      const int column = columns[i];
      const int lane = column - x;
      BlockGroup& group = groups[i];
      group.size = sizes[lane];
      for (int k = 0; k < group.size; ++k) {
        const int nearest = scratch.nearest(column, scratch.taken(k, lane));
        const auto& candidate = search.pattern.candidates()[static_cast<std::size_t>(nearest)];
        group.blocks[k] = {search.row.x + kCellPx * column + candidate.dx,
                           search.row.y + candidate.dy};
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(quantise_row);
HWY_EXPORT(begin_pairs);
HWY_EXPORT(match_row);

SearchPattern::SearchPattern(int radius_px) : radius_px_(radius_px) {
  constexpr int kDenseRadius = 6;
  constexpr int kDenseClassPx = 2;
  constexpr int kSparseClassPx = 4;
  // Numbers of the classes, by their first displacement; dense ones and sparse ones may share it.
  const int side = 2 * radius_px + 1;
  std::vector<int> numbers(static_cast<std::size_t>(2 * side * side), -1);
  for (int dy = -radius_px; dy <= radius_px; ++dy) {
    row_begin_.push_back(static_cast<int>(candidates_.size()));
    for (int dx = -radius_px; dx <= radius_px; ++dx) {
      const bool dense = std::max(std::abs(dx), std::abs(dy)) <= kDenseRadius;
      if (dx * dx + dy * dy > radius_px * radius_px || (!dense && (dx + dy) % 2 != 0)) {
        continue;
      }
      const int class_px = dense ? kDenseClassPx : kSparseClassPx;
      const int first_x = (dx + radius_px) / class_px * class_px;
      const int first_y = (dy + radius_px) / class_px * class_px;
      int& number =
          numbers[static_cast<std::size_t>(2 * (first_y * side + first_x) + (dense ? 1 : 0))];
      if (number < 0) {
        number = classes_++;
      }
      candidates_.push_back({dx, dy, number});
    }
  }
  row_begin_.push_back(static_cast<int>(candidates_.size()));
}

std::span<const SearchPattern::Candidate> SearchPattern::row(int dy) const {
  return candidates().subspan(static_cast<std::size_t>(row_begin(dy)),
                              static_cast<std::size_t>(row_begin(dy + 1) - row_begin(dy)));
}

int MatchGuide::readable_width(int width) { return rounded_up(width, kCellPx * kWidestLanes / 2); }

void MatchGuide::resize(int width, int height, int radius_px) {
  assert(width % kCellPx == 0 && height % kCellPx == 0);
  width_ = width;
  height_ = height;
  margin_ = radius_px / kCellPx + 2;
  phases_.resize(rounded_up(width / kCellPx, kWidestLanes) + 2 * margin_, height * kCellPx);
}

void MatchGuide::set_row(const float* values, int y) {
  HWY_DYNAMIC_DISPATCH(quantise_row)
  (values, width_ / kCellPx, phases_.row(y * kCellPx) + margin_, phases_.stride());
}

void MatchScratch::prepare(const SearchPattern& pattern, int cells_in_row) {
  const int columns = rounded_up(cells_in_row + 1, kWidestLanes);  // and the cell right of them
  cells.resize(columns, 2 * pattern.radius_px() + 1);
  pairs.resize(columns, static_cast<int>(pattern.candidates().size()));
  least.resize(columns, pattern.classes());
  nearest.resize(columns, pattern.classes());
  taken.resize(kLargestGroup, kWidestLanes);
}

void match_row(const MatchGuide& guide, const SearchPattern& pattern, const ReferenceRow& row,
               int largest_group, MatchScratch& scratch, std::span<BlockGroup> groups) {
  const Search search{guide, pattern, row};
  scratch.prepare(pattern, search.lanes());
  if (scratch.pairs_cells < search.lanes() || scratch.pairs_x != row.x ||
      scratch.pairs_y + kCellPx != row.y) {
    HWY_DYNAMIC_DISPATCH(begin_pairs)(search, scratch);
  }
  scratch.pairs_x = row.x;
  scratch.pairs_y = row.y;
  scratch.pairs_cells = search.lanes();
  HWY_DYNAMIC_DISPATCH(match_row)(search, largest_group, scratch, groups);
}

}  // namespace thermedge::detail
#endif
