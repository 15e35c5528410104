#include "simd/bm3d_match.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/bm3d_match.cpp"
#include "simd/config.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Outside the target namespaces: one definition for all of them.
#ifndef THERMEDGE_SIMD_BM3D_MATCH_ONCE
#define THERMEDGE_SIMD_BM3D_MATCH_ONCE
namespace thermedge::detail {

inline constexpr int kLargestLanes = 32;
inline constexpr int kLargestWindow = 2 * kLargestSearchRadius + 1;
inline constexpr int kBlockPixels = kBlockPx * kBlockPx;

}  // namespace thermedge::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U16 = hn::CappedTag<std::uint16_t, kLargestLanes>;
using I16 = hn::RebindToSigned<U16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(U16()));

// Each pixel of the reference block in all lanes of a vector.
struct ReferenceBlock {
  ReferenceBlock(ImageView<const std::int16_t> levels, BlockPosition at) {
    for (int i = 0; i < kBlockPixels; ++i) {
      const std::int16_t level = levels(at.x + i % kBlockPx, at.y + i / kBlockPx);
      hn::Store(hn::Set(I16(), level), I16(), pixels + i * kLanes);
    }
  }
  HWY_ALIGN std::int16_t pixels[kBlockPixels * kLanes];
};

// Distances of kRows x kLanes blocks, the first at `first`; a row of candidate pixels is loaded
// once for all blocks that it is part of.
template <int kRows>
HWY_INLINE void distances_at(const std::int16_t* first, std::ptrdiff_t stride,
                             const ReferenceBlock& reference, std::uint16_t* distances,
                             std::ptrdiff_t distances_stride) {
  const U16 d;
  const I16 di;
  const auto largest = hn::Set(d, 255);
  hn::Vec<U16> sums[kRows];
  for (auto& sum : sums) {
    sum = hn::Zero(d);
  }
  for (int y = 0; y < kBlockPx + kRows - 1; ++y) {
    for (int x = 0; x < kBlockPx; ++x) {
      const auto candidate = hn::LoadU(di, first + y * stride + x);
      HWY_UNROLL(4)
      for (int row = 0; row < kRows; ++row) {
        const int y_in_block = y - row;
        if (y_in_block >= 0 && y_in_block < kBlockPx) {
          const auto* pixel = reference.pixels + (y_in_block * kBlockPx + x) * kLanes;
          const auto difference = hn::BitCast(d, hn::Abs(candidate - hn::Load(di, pixel)));
          const auto level = hn::Min(difference, largest);
          sums[row] = hn::SaturatedAdd(sums[row], level * level);
        }
      }
    }
  }
  for (int row = 0; row < kRows; ++row) {
    hn::Store(sums[row], d, distances + row * distances_stride);
  }
}

// Distances of the blocks in columns [first_column, end_column), kLanes at a time.
void distances_by_rows(ImageView<const std::int16_t> levels, const ReferenceBlock& reference,
                       const SearchWindow& window, int first_column, int end_column,
                       ImageView<std::uint16_t> distances) {
  constexpr int kRows = 4;
  for (int x = first_column; x < end_column; x += kLanes) {
    int y = 0;
    for (; y + kRows <= window.height; y += kRows) {
      distances_at<kRows>(levels.row(window.y + y) + window.x + x, levels.stride(), reference,
                          distances.row(y) + x, distances.stride());
    }
    for (; y < window.height; ++y) {
      distances_at<1>(levels.row(window.y + y) + window.x + x, levels.stride(), reference,
                      distances.row(y) + x, distances.stride());
    }
  }
}

// The same for a few columns, along which the blocks fill vectors better than along the rows.
void distances_by_columns(ImageView<const std::int16_t> transposed,
                          const ReferenceBlock& transposed_reference, const SearchWindow& window,
                          int first_column, int end_column, ImageView<std::uint16_t> distances) {
  HWY_ALIGN std::uint16_t column[kLargestWindow + kLargestLanes];
  for (int x = first_column; x < end_column; ++x) {
    for (int y = 0; y < window.height; y += kLanes) {
      distances_at<1>(transposed.row(window.x + x) + window.y + y, transposed.stride(),
                      transposed_reference, column + y, 0);
    }
    for (int y = 0; y < window.height; ++y) {
      distances(x, y) = column[y];
    }
  }
}

// Distances of all blocks of the window; lanes behind its last column get the largest. A window of
// 2 r + 1 columns leaves a single one behind its whole vectors.
void window_distances(const MatchGuide& guide, BlockPosition at, const SearchWindow& window,
                      ImageView<std::uint16_t> distances) {
  constexpr int kFewColumns = 4;
  const int whole = window.width / kLanes * kLanes;
  const bool few_left = window.width - whole <= kFewColumns;
  const int by_rows = few_left ? whole : window.width;
  distances_by_rows(guide.levels, ReferenceBlock(guide.levels, at), window, 0, by_rows, distances);
  if (by_rows < window.width) {
    const ReferenceBlock transposed(guide.transposed, {at.y, at.x});
    distances_by_columns(guide.transposed, transposed, window, by_rows, window.width, distances);
  }
  const int padded = (window.width + kLanes - 1) / kLanes * kLanes;
  for (int y = 0; y < window.height; ++y) {
    std::fill(distances.row(y) + window.width, distances.row(y) + padded, std::uint16_t{0xffff});
  }
}

// The element of rank `rank` (1: the smallest) of `vectors` vectors, found bit by bit from the top;
// 65535 where there are fewer.
HWY_INLINE std::uint16_t ranked(const std::uint16_t* values, int vectors, int rank) {
  const U16 d;
  unsigned found = 0;
  for (unsigned bit = 0x8000; bit != 0; bit >>= 1) {
    const auto limit = hn::Set(d, static_cast<std::uint16_t>(found | bit));
    int below = 0;
    for (int i = 0; i < vectors; ++i) {
      below += static_cast<int>(hn::CountTrue(d, hn::Load(d, values + i * kLanes) < limit));
    }
    if (below < rank) {
      found |= bit;
    }
  }
  return static_cast<std::uint16_t>(found);
}

// A distance that at least `rank` blocks do not exceed: the element of this rank among the
// smallest of every fourth row of each column.
HWY_INLINE std::uint16_t bound_of(ImageView<const std::uint16_t> distances,
                                  const SearchWindow& window, int rank) {
  constexpr int kParts = 4;
  const U16 d;
  HWY_ALIGN std::uint16_t smallest[kParts * (kLargestWindow + kLargestLanes)];
  int vectors = 0;
  for (int x = 0; x < window.width; x += kLanes) {
    for (int part = 0; part < kParts; ++part) {
      auto least = hn::Set(d, 0xffff);
      for (int y = part; y < window.height; y += kParts) {
        least = hn::Min(least, hn::Load(d, distances.row(y) + x));
      }
      hn::Store(least, d, smallest + vectors * kLanes);
      ++vectors;
    }
  }
  return ranked(smallest, vectors, rank);
}

// Collects the blocks within `bound` but the reference block, in the order of their index; returns
// their number.
int collect(const SearchWindow& window, std::uint16_t bound, int reference_index,
            MatchScratch& scratch) {
  const U16 d;
  const auto limit = hn::Set(d, bound);
  std::uint16_t* distances = scratch.candidates.row(0);
  std::uint16_t* indices = scratch.candidates.row(1);
  int count = 0;
  for (int y = 0; y < window.height; ++y) {
    const std::uint16_t* row = scratch.distances.row(y);
    for (int x = 0; x < window.width; x += kLanes) {
      HWY_ALIGN std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, hn::Not(hn::Load(d, row + x) > limit), bits);
      std::uint64_t lanes = 0;
      hwy::CopyBytes<sizeof(lanes)>(bits, &lanes);
      for (; lanes != 0; lanes &= lanes - 1) {
        const int column = x + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes));
        const int index = y * window.width + column;
        if (column < window.width && index != reference_index) {
          distances[count] = row[column];
          indices[count] = static_cast<std::uint16_t>(index);
          ++count;
        }
      }
    }
  }
  return count;
}

// Keeps the `count` smallest (distance, index) of `candidates` as distance << 16 | index, sorted.
void keep_nearest(MatchScratch& scratch, int candidates, int count, std::uint32_t* keys) {
  std::uint16_t* distances = scratch.candidates.row(0);
  const std::uint16_t* indices = scratch.candidates.row(1);
  std::fill(distances + candidates, distances + candidates + kLanes, std::uint16_t{0xffff});
  const int vectors = (candidates + kLanes - 1) / kLanes;
  const std::uint16_t last = ranked(distances, vectors, count);
  int kept = 0;
  int ties = count;  // candidates at the last distance that are kept: those of the lowest indices
  for (int i = 0; i < candidates; ++i) {
    ties -= distances[i] < last;
  }
  for (int i = 0; i < candidates && kept < count; ++i) {
    if (distances[i] < last || (distances[i] == last && ties-- > 0)) {
      keys[kept++] = std::uint32_t{distances[i]} << 16 | indices[i];
    }
  }
  std::sort(keys, keys + kept);
}

void match_blocks(const MatchGuide& guide, BlockPosition reference, const SearchWindow& window,
                  int count, MatchScratch& scratch, BlockPosition* group) {
  group[0] = reference;
  if (count == 1) {
    return;
  }
  window_distances(guide, reference, window, scratch.distances);
  // The reference block is among those within the bound, hence `count` and not one less.
  const std::uint16_t bound = bound_of(scratch.distances, window, count);
  const int reference_index = (reference.y - window.y) * window.width + (reference.x - window.x);
  const int candidates = collect(window, bound, reference_index, scratch);
  std::uint32_t keys[kLargestGroup];
  keep_nearest(scratch, candidates, count - 1, keys);
  for (int i = 1; i < count; ++i) {
    const auto index = static_cast<int>(keys[i - 1] & 0xffff);
    group[i] = {window.x + index % window.width, window.y + index / window.width};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

MatchScratch::MatchScratch()
    : distances(kLargestWindow + kLargestLanes, kLargestWindow),
      candidates(kLargestWindow * kLargestWindow + kLargestLanes, 2) {}

HWY_EXPORT(match_blocks);

void match_blocks(const MatchGuide& guide, BlockPosition reference, const SearchWindow& window,
                  int count, MatchScratch& scratch, BlockPosition* group) {
  HWY_DYNAMIC_DISPATCH(match_blocks)(guide, reference, window, count, scratch, group);
}

}  // namespace thermedge::detail
#endif
