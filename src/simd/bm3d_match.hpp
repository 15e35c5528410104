// Block matching for BM3D.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::detail {

inline constexpr int kBlockPx = 8;               // side of a block
inline constexpr int kLargestGroup = 32;         // blocks
inline constexpr int kLargestSearchRadius = 32;  // px

// Top left pixel of a block.
struct BlockPosition {
  int x = 0;
  int y = 0;
  friend bool operator==(const BlockPosition&, const BlockPosition&) = default;
};

// The blocks among which matches are sought: top left corners in [x, x + width) x [y, y + height).
struct SearchWindow {
  int x = 0;
  int y = 0;
  int width = 1;
  int height = 1;
};

// Scratch memory of match_blocks; one for each task that runs at a time.
struct MatchScratch {
  MatchScratch();
  Image<std::uint16_t> distances;   // of the blocks of the window
  Image<std::uint16_t> candidates;  // row 0: distances, row 1: indices of blocks near enough
};

// What blocks are compared on: integers, and the same transposed.
struct MatchGuide {
  ImageView<const std::int16_t> levels;
  ImageView<const std::int16_t> transposed;
};

// Finds the `count` blocks of the window that are most like the one at `reference`, which lies in
// the window and is always the first of `group`. The others follow by (distance, index), smallest
// first; the index numbers the window row by row. The distance is the sum of squared differences of
// levels (modulo 2^16, a difference counting at most 255), at most 65535.
// 1 <= count <= min(kLargestGroup, window.width * window.height).
void match_blocks(const MatchGuide& guide, BlockPosition reference, const SearchWindow& window,
                  int count, MatchScratch& scratch, BlockPosition* group);

}  // namespace thermedge::detail
