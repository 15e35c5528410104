// Weighted means over a search window for non-local means.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::detail {

inline constexpr int kLargestDistance = 65535;
inline constexpr int kNlmSlack = 32;  // elements that a kernel may write past the last column

inline constexpr int kNlmScratchRows = 2;

// Rows of scratch that a band of `rows` needs.
[[nodiscard]] constexpr int nlm_box_rows(int rows, int patch_px) {
  return rows + patch_px - 1 + kNlmScratchRows;
}

// Weights of a patch's pixels along either side: 1 2 ... half ... 2 1; their sum is half^2.
[[nodiscard]] constexpr int nlm_patch_half(int patch_px) { return (patch_px + 1) / 2; }

// Whether the search window of +- `reach` looks at this displacement: within a disc, all of them up
// to half its radius, farther off every other one of every other row. Near patches are the likelier
// matches, and all of the far ones together would outweigh them.
[[nodiscard]] constexpr bool nlm_samples(int dx, int dy, int reach) {
  const int square = dx * dx + dy * dy;
  const bool near = 4 * square <= reach * reach;
  return square <= reach * (reach + 1) && (near || (dx % 2 == 0 && dy % 2 == 0));
}

// The weight of distance s is 2^(-max(s - noise, 0) * halvings), and 0 at
// kLargestDistance.
struct NlmWeights {
  float noise = 0;
  float halvings = 0;
};

// A band of rows of the result. `values` and `levels` have margins of search_px / 2 + patch_px / 2
// on all sides; `sums` and `weights` are the band's own rows, at least `width` + kNlmSlack wide.
struct NlmBand {
  ImageView<const float> values;
  ImageView<const std::uint16_t> levels;
  ImageView<std::uint16_t> boxes;  // scratch: nlm_box_rows rows as wide as levels, and the slack
  ImageView<float> sums;
  ImageView<float> weights;
  int first_row = 0;  // of the band within the frame
  int width = 0;      // of the frame
};

// Fills sums with the weighted values of the search window around each pixel, and weights with the
// sum of their weights. The distance of two patches is the weighted sum of squared differences of
// their levels (modulo 2^16, a difference counting at most 255), at most kLargestDistance.
void nlm_band(const NlmBand& band, int patch_px, int search_px, const NlmWeights& weights);

}  // namespace thermedge::detail
