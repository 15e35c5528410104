// Kernels of the noise's map.
#pragma once

namespace thermedge::detail {

// Pixels of a row between two columns of nodes: their levels are left + share * step.
struct LevelRun {
  const double* shares;
  double left;
  double step;
  int count;
};

void level_run(const LevelRun& run, float* out);
// out = offset + (in - middle) / level. `out` may be `in`.
void even_out_run(const LevelRun& run, const float* in, float middle, float offset, float* out);
// values = values * level + middle.
void undo_even_out_run(const LevelRun& run, float middle, float* values);

}  // namespace thermedge::detail
