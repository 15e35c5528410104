// The cosine transform of blocks of counts, on whole numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "thermedge/noise_model.hpp"

namespace thermedge::detail {

// Orthonormal, but for the rounding of cosines to 11 bits; [8 v + u], u across. All sums are exact
// until the last one is rounded, so their order makes no difference. `block`: kNoiseBlockPx rows
// of as many counts.
void noise_block(const std::uint16_t* block, std::ptrdiff_t stride,
                 std::array<float, kNoiseBlockPx * kNoiseBlockPx>& out);

}  // namespace thermedge::detail
