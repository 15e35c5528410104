// Block matching for BM3D: all reference blocks of a row at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge::detail {

inline constexpr int kBlockPx = 8;               // side of a block
inline constexpr int kCellPx = 4;                // a block is 2 x 2 cells
inline constexpr int kLargestGroup = 32;         // blocks
inline constexpr int kLargestSearchRadius = 32;  // px

// Top left pixel of a block.
struct BlockPosition {
  int x = 0;
  int y = 0;
  friend bool operator==(const BlockPosition&, const BlockPosition&) = default;
};

// A reference block and those most like it; `size` is a power of two.
struct BlockGroup {
  [[nodiscard]] std::span<const BlockPosition> view() const {
    return {blocks, static_cast<std::size_t>(size)};
  }
  int size = 0;
  BlockPosition blocks[kLargestGroup];
};

// Where matches are sought around a reference block: the displacements within a disc, near by all
// of them and farther off every other one. They are sorted into classes of neighbours. Of a class
// only the best match joins the group: blocks that overlap almost wholly have almost the same
// noise, so a second one adds little.
class SearchPattern {
 public:
  struct Candidate {
    int dx = 0;
    int dy = 0;
    int neighbours = 0;  // number of its class
  };

  // Parts of a frame: which quarter of it a place lies in, and whether it is farther from the
  // middle across than down. Mirroring and turning a frame takes its octants into each other.
  static constexpr int kOctants = 8;

  // `with_adjacent`: blocks displaced by a pixel may join a group.
  SearchPattern(int radius_px, bool with_adjacent, const Bm3dTuning& tuning = {});

  [[nodiscard]] int radius_px() const { return radius_px_; }
  [[nodiscard]] int classes() const { return classes_; }
  // By dy, then by dx; those of a class and a dy follow each other.
  [[nodiscard]] std::span<const Candidate> candidates() const { return candidates_; }
  [[nodiscard]] std::span<const Candidate> row(int dy) const;
  [[nodiscard]] int row_begin(int dy) const {
    return row_begin_[static_cast<std::size_t>(dy + radius_px_)];
  }
  // Which of equally good candidates goes first for a reference block in this octant (0: the
  // first): the same one in a mirrored or turned frame.
  [[nodiscard]] std::span<const std::uint16_t> ranks(int octant) const {
    return std::span(ranks_).subspan(index_of(octant, 0), candidates_.size());
  }
  [[nodiscard]] const Candidate& of_rank(int octant, std::uint32_t rank) const {
    return candidates_[of_ranks_[index_of(octant, static_cast<int>(rank))]];
  }

 private:
  void rank_candidates();
  [[nodiscard]] std::size_t index_of(int octant, int i) const {
    return static_cast<std::size_t>(octant) * candidates_.size() + static_cast<std::size_t>(i);
  }

  int radius_px_;
  int classes_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<int> row_begin_;           // for each dy, and the end
  std::vector<std::uint16_t> ranks_;     // of each candidate, octant by octant
  std::vector<std::uint16_t> of_ranks_;  // candidates by their ranks
};

// The octant of the frame in which the middle of a block lies.
[[nodiscard]] int octant_of(BlockPosition block, int width, int height);

// What blocks are compared on: a frame as integers of a fraction of its noise, modulo 2^16 (small
// differences stay right where the frame has a huge range).
class MatchGuide {
 public:
  // For frames of this size, multiples of kCellPx and at least a block, and displacements of up to
  // `radius_px`.
  void resize(int width, int height, int radius_px);

  // Quantises row `y`. `values` are in units of the noise, readable up to readable_width().
  void set_row(const float* values, int y);

  [[nodiscard]] static int readable_width(int width);
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  // Row y * kCellPx + p, column margin() + X: pixel (kCellPx * X + p, y), so that neighbouring
  // reference blocks are neighbours here. Columns outside the frame hold anything.
  [[nodiscard]] ImageView<const std::int16_t> phases() const { return phases_; }
  [[nodiscard]] int margin() const { return margin_; }
  [[nodiscard]] std::size_t memory_bytes() const { return memory_of(phases_); }

 private:
  int width_ = 0;
  int height_ = 0;
  int margin_ = 0;
  Image<std::int16_t> phases_;
};

// Reference blocks at x + kCellPx * columns[i], rising, all in row y.
struct ReferenceRow {
  int x = 0;
  int y = 0;
  std::span<const int> columns;
};

// Scratch memory of match_row; one for each task that runs at a time. Columns are reference blocks.
struct MatchScratch {
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(cells, pairs, least, nearest, is_right, taken, keys);
  }

  // For rows that reach over this many cells; match_row does it otherwise.
  void prepare(const SearchPattern& pattern, int cells_in_row);

  Image<std::uint16_t> cells;    // a row for each candidate of one dy: sums over cells
  Image<std::uint16_t> pairs;    // a row for each candidate: sums over the lower halves of blocks
  Image<std::int16_t> least;     // a row for each class: its least distance
  Image<std::int16_t> nearest;   // and the number of the candidate that has it
  Image<std::int16_t> is_right;  // 1 for the blocks right of the middle of the frame
  Image<std::int16_t> taken;     // a row for each lane of a vector: the classes listed
  std::vector<std::uint32_t> keys;  // of the candidates for one group: distance, then rank
  // What `pairs` belongs to: rows of reference blocks with this first one, so many cells long.
  int pairs_x = 0;
  int pairs_y = 0;
  int pairs_cells = 0;  // 0: nothing
};

// For each reference block of the row the group of the blocks in the frame that are most like it;
// group i is that of the i-th. Its size is the largest power of two up to `largest_group` for which
// there are classes. The distance is the sum of absolute differences of levels plus 1, at most
// 32765; that of the reference block to itself is 0. The group is sorted by distance, those at the
// same distance by their rank in the octant of the reference block. Of equals within a class the
// one farther from the middle of the frame wins, by row, then by column.
//
// Sums are taken over cells. Those of the lower cells serve again as upper ones if the next call
// with this scratch is for the row kCellPx below; forget them (pairs_cells = 0) when the guide
// changes.
void match_row(const MatchGuide& guide, const SearchPattern& pattern, const ReferenceRow& row,
               int largest_group, MatchScratch& scratch, std::span<BlockGroup> groups);

}  // namespace thermedge::detail
