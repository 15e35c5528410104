// Rows of sums and weights of BM3D's aggregation.
#pragma once

#include <cstddef>

namespace thermedge::detail {

// sums[x] += more[x].
void add_row(const float* more, int width, float* sums);

// out[x] = sum of profile[i] * in[x - i * step] over i < 8: `step` 1 along a row, a stride along
// columns. `out` is not `in`.
void spread_row(const float* profile, const float* in, std::ptrdiff_t step, int width, float* out);

// values[x] = sums[x] / values[x].
void divide_row(const float* sums, int width, float* values);

}  // namespace thermedge::detail
