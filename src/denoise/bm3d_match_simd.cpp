#include "bm3d_match_simd.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <numeric>
#include <tuple>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bm3d_match_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

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
inline constexpr float kLevelsPerSigma = 8;

// So many tied classes are sorted at once; of more, the nearest are picked out before.
inline constexpr int kMostSorted = 48;

inline int rounded_up(int value, int multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

struct Search {
  [[nodiscard]] int last_x() const { return guide.width() - kBlockPx; }
  [[nodiscard]] int last_y() const { return guide.height() - kBlockPx; }
  // Cells from x on at which a block may begin, so that the next row finds all sums it needs.
  [[nodiscard]] int lanes() const { return (last_x() - row.x) / kCellPx + 1; }

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

// 1 in the lanes of the blocks right of the middle of the frame.
HWY_INLINE hn::Vec<I16> right_of_middle(const Search& search, int x) {
  const I16 di;
  const int last_left = (search.last_x() - 2 * search.row.x) >> 3;  // cell
  const auto cells = hn::Iota(di, static_cast<std::int16_t>(x));
  return hn::IfThenElseZero(cells > hn::Set(di, static_cast<std::int16_t>(last_left)),
                            hn::Set(di, 1));
}

// For the candidates `first` to `end` of a row, which are of one class: the least distance and the
// outermost candidate that has it, against the best of the rows before; and the sums over the lower
// halves of all blocks.
HWY_INLINE void find_nearest_of_class(const Search& search, int dy, int first, int end,
                                      MatchScratch& scratch) {
  const U16 d;
  const I16 di;
  const SearchPattern& pattern = search.pattern;
  const auto candidates = pattern.row(dy);
  const bool inside = search.row.y + dy >= 0;
  const int neighbours = candidates[static_cast<std::size_t>(first)].neighbours;
  std::int16_t* least = scratch.least.row(neighbours);
  std::int16_t* nearest = scratch.nearest.row(neighbours);
  for (int x = 0; x < search.lanes(); x += kLanes) {
    const auto bias = hn::Load(di, scratch.is_right.row(0) + x);
    auto best = hn::Set(di, kNoMatch);
    auto best_index = hn::Zero(di);
    for (int k = first; k < end; ++k) {
      const int index = pattern.row_begin(dy) + k;
      std::uint16_t* pairs = scratch.pairs.row(index);
      const auto lower = sum_of_two(scratch.cells.row(k) + x);
      if (inside) {
        const auto sums = hn::SaturatedAdd(hn::Load(d, pairs + x), lower);
        const auto distance =
            distances_of(search, candidates[static_cast<std::size_t>(k)], x, sums);
        const auto is_better = distance < best + bias;  // of equals, the first or the last
        best = hn::Min(distance, best);
        best_index =
            hn::IfThenElse(is_better, hn::Set(di, static_cast<std::int16_t>(index)), best_index);
      }
      hn::Store(lower, d, pairs + x);
    }
    if (inside) {
      const auto before = hn::Load(di, least + x);
      hn::Store(hn::IfThenElse(best < before, best_index, hn::Load(di, nearest + x)), di,
                nearest + x);
      hn::Store(hn::Min(best, before), di, least + x);
    }
  }
}

// Of each class the least distance and the outermost candidate that has it.
void find_nearest(const Search& search, MatchScratch& scratch) {
  const SearchPattern& pattern = search.pattern;
  fill_pixels(scratch.least.view(), kNoMatch);
  const bool is_upper = 2 * search.row.y <= search.last_y();
  for (int x = 0; x < search.lanes(); x += kLanes) {
    hn::Store(right_of_middle(search, x), I16(), scratch.is_right.row(0) + x);
  }
  for (int step = -pattern.radius_px(); step <= pattern.radius_px(); ++step) {
    const int dy = is_upper ? step : -step;
    const int y = search.row.y + dy;
    if (y < -kCellPx || y > search.last_y()) {
      continue;
    }
    const auto candidates = pattern.row(dy);
    sum_cells(search, search.row.y + kCellPx, dy, scratch.cells);
    const auto neighbours_of = [&](int k) {
      return candidates[static_cast<std::size_t>(k)].neighbours;
    };
    const auto count = static_cast<int>(candidates.size());
    for (int first = 0; first < count;) {
      int end = first + 1;
      while (end < count && neighbours_of(end) == neighbours_of(first)) {
        ++end;
      }
      find_nearest_of_class(search, dy, first, end, scratch);
      first = end;
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

// Lists for each of the lanes `used` the classes of the sizes[lane] least distances, and those that
// tie with the last of them; fills listed[lane] with how many there are.
void list_nearest(int x, int largest_group, const std::int16_t* sizes, std::uint64_t used,
                  MatchScratch& scratch, int* listed) {
  const I16 d;
  const auto one = hn::Set(d, 1);
  const auto wanted = hn::Load(d, sizes);
  // Bisection: no more than `wanted` classes but too few lie within `low`, enough within `high`.
  auto low = hn::Set(d, -1);
  auto high = bound_of(scratch, x, largest_group);
  while (!hn::AllFalse(d, high - low > one)) {
    const auto middle = low + hn::ShiftRight<1>(high - low);
    const auto count = count_within(scratch, x, middle);
    const auto too_few = wanted > count;
    low = hn::IfThenElse(too_few, middle, low);
    high = hn::IfThenElse(too_few, high, middle);
    // Just enough: no need to go on.
    low = hn::IfThenElse(count == wanted, middle, low);
  }
  std::fill_n(listed, kLanes, 0);
  for (int i = 0; i < scratch.least.height(); ++i) {
    const auto beyond = hn::Load(d, scratch.least.row(i) + x) > high;
    std::uint64_t lanes = ~lanes_of(beyond) & used;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes));
      scratch.taken(listed[lane]++, lane) = static_cast<std::int16_t>(i);
    }
  }
}

// Sorts up to kMostSorted different keys; `keys` has a vector to spare.
void sort_keys(std::uint32_t* keys, int count) {
  const hn::CappedTag<std::uint32_t, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  HWY_ALIGN std::uint32_t sorted[kMostSorted + 16];
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto self = hn::BitCast(di, hn::LoadU(d, keys + i));
    auto place = hn::Zero(di);
    for (int k = 0; k < count; ++k) {
      const auto other = hn::Set(di, static_cast<std::int32_t>(keys[k]));
      place = place - hn::VecFromMask(di, other < self);  // true is -1
    }
    HWY_ALIGN std::int32_t places[16];
    hn::Store(place, di, places);
    const int lanes = std::min(static_cast<int>(hn::Lanes(d)), count - i);
    for (int lane = 0; lane < lanes; ++lane) {
      sorted[places[lane]] = keys[i + lane];
    }
  }
  std::copy_n(sorted, count, keys);
}

// The group of the reference block in this column and lane, from the classes listed for it.
void make_group(const Search& search, int column, int lane, int listed, int size,
                MatchScratch& scratch, BlockGroup& group) {
  const BlockPosition at = {search.row.x + kCellPx * column, search.row.y};
  const int octant = octant_of(at, search.guide.width(), search.guide.height());
  std::uint32_t* keys = scratch.keys.data();
  const std::int16_t* taken = scratch.taken.row(lane);
  const std::int16_t* least = scratch.least.row(0) + column;
  const std::int16_t* nearest = scratch.nearest.row(0) + column;
  const std::uint16_t* ranks = search.pattern.ranks(octant).data();
  const std::ptrdiff_t stride = scratch.least.stride();  // and that of `nearest`
  for (int k = 0; k < listed; ++k) {
    const std::ptrdiff_t row = taken[k] * stride;
    keys[k] = static_cast<std::uint32_t>(least[row]) << 16U | ranks[nearest[row]];
  }
  if (listed > kMostSorted) {
    std::nth_element(keys, keys + size, keys + listed);
    listed = size;
  }
  sort_keys(keys, listed);
  group.size = size;
  for (int k = 0; k < size; ++k) {
    const auto& candidate = search.pattern.of_rank(octant, keys[k] & 0xffffU);
    group.blocks[k] = {at.x + candidate.dx, at.y + candidate.dy};
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
    int listed[kLanes];
    list_nearest(x, largest_group, sizes, used, scratch, listed);
    for (; i < columns.size() && columns[i] < x + kLanes; ++i) {
      const int lane = columns[i] - x;
      make_group(search, columns[i], lane, listed[lane], sizes[lane], scratch, groups[i]);
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

SearchPattern::SearchPattern(int radius_px, bool with_adjacent, const Bm3dTuning& tuning)
    : radius_px_(radius_px) {
  // Squares of displacements around the one in the middle, which is narrower or wider by a pixel,
  // so that a mirrored pattern has mirrored classes. The middle one of the dense classes holds the
  // reference block alone, or also the blocks adjacent to it, which then never join its group.
  const auto place_of = [&](int displacement, int class_px) {
    const bool is_narrow = class_px == tuning.sparse_class_px || with_adjacent;
    const int place = (std::abs(displacement) + (is_narrow ? 1 : 0)) / class_px;
    return radius_px + (displacement < 0 ? -place : place);
  };
  // Numbers of the classes, by their places; dense ones and sparse ones may share them.
  const int side = 2 * radius_px + 1;
  std::vector<int> numbers(static_cast<std::size_t>(2 * side * side), -1);
  for (int dy = -radius_px; dy <= radius_px; ++dy) {
    row_begin_.push_back(static_cast<int>(candidates_.size()));
    for (int dx = -radius_px; dx <= radius_px; ++dx) {
      const bool dense = std::max(std::abs(dx), std::abs(dy)) <= tuning.dense_radius_px;
      if (dx * dx + dy * dy > radius_px * radius_px || (!dense && (dx + dy) % 2 != 0)) {
        continue;
      }
      const int class_px = dense ? tuning.dense_class_px : tuning.sparse_class_px;
      const int place = place_of(dy, class_px) * side + place_of(dx, class_px);
      int& number = numbers[static_cast<std::size_t>(2 * place + (dense ? 1 : 0))];
      if (number < 0) {
        number = classes_++;
      }
      candidates_.push_back({dx, dy, number});
    }
  }
  row_begin_.push_back(static_cast<int>(candidates_.size()));
  rank_candidates();
}

void SearchPattern::rank_candidates() {
  const std::size_t count = candidates_.size();
  ranks_.resize(kOctants * count);
  of_ranks_.resize(kOctants * count);
  for (int octant = 0; octant < kOctants; ++octant) {
    // As seen from the first octant: nearest first, then those that lie farther outwards.
    const auto order_of = [&](std::uint16_t i) {
      const int x = (octant & 1) != 0 ? -candidates_[i].dx : candidates_[i].dx;
      const int y = (octant & 2) != 0 ? -candidates_[i].dy : candidates_[i].dy;
      const bool swapped = (octant & 4) != 0;
      return std::tuple(-(x * x + y * y), swapped ? -y : -x, swapped ? -x : -y);
    };
    const auto of_rank =
        std::span(of_ranks_).subspan(static_cast<std::size_t>(octant) * count, count);
    std::iota(of_rank.begin(), of_rank.end(), std::uint16_t{0});
    std::sort(of_rank.begin(), of_rank.end(),
              [&](std::uint16_t a, std::uint16_t b) { return order_of(a) < order_of(b); });
    for (std::size_t rank = 0; rank < count; ++rank) {
      ranks_[static_cast<std::size_t>(octant) * count + of_rank[rank]] =
          static_cast<std::uint16_t>(rank);
    }
  }
}

int octant_of(BlockPosition block, int width, int height) {
  const int x = 2 * block.x + kBlockPx - width;
  const int y = 2 * block.y + kBlockPx - height;
  return (x < 0 ? 1 : 0) + (y < 0 ? 2 : 0) + (std::abs(x) < std::abs(y) ? 4 : 0);
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
  THERMEDGE_SIMD_DISPATCH(quantise_row)
  (values, width_ / kCellPx, phases_.row(y * kCellPx) + margin_, phases_.stride());
}

void MatchScratch::prepare(const SearchPattern& pattern, int cells_in_row) {
  const int columns = rounded_up(cells_in_row + 1, kWidestLanes);  // and the cell right of them
  cells.resize(columns, 2 * pattern.radius_px() + 1);
  pairs.resize(columns, static_cast<int>(pattern.candidates().size()));
  least.resize(columns, pattern.classes());
  nearest.resize(columns, pattern.classes());
  is_right.resize(columns, 1);
  taken.resize(pattern.classes(), kWidestLanes);
  keys.resize(static_cast<std::size_t>(std::max(pattern.classes(), kMostSorted) + kWidestLanes));
}

void match_row(const MatchGuide& guide, const SearchPattern& pattern, const ReferenceRow& row,
               int largest_group, MatchScratch& scratch, std::span<BlockGroup> groups) {
  const Search search{guide, pattern, row};
  scratch.prepare(pattern, search.lanes());
  if (scratch.pairs_cells < search.lanes() || scratch.pairs_x != row.x ||
      scratch.pairs_y + kCellPx != row.y) {
    THERMEDGE_SIMD_DISPATCH(begin_pairs)(search, scratch);
  }
  scratch.pairs_x = row.x;
  scratch.pairs_y = row.y;
  scratch.pairs_cells = search.lanes();
  THERMEDGE_SIMD_DISPATCH(match_row)(search, largest_group, scratch, groups);
}

}  // namespace thermedge::detail
#endif
