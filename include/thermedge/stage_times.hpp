// How long each stage of a detection took.
#pragma once

#include <string_view>
#include <vector>

namespace thermedge {

struct StageTime {
  std::string_view stage;  // e.g. "denoise"; the same stages in the same order for every frame
  double ms = 0;           // wall time
};

using StageTimes = std::vector<StageTime>;

[[nodiscard]] inline double total_ms(const StageTimes& times) {
  double sum = 0;
  for (const StageTime& time : times) {
    sum += time.ms;
  }
  return sum;
}

}  // namespace thermedge
