// Times the stages of a pipeline, and stops it between two of them.
#pragma once

#include <chrono>
#include <stop_token>
#include <string_view>
#include <utility>

#include "thermedge/result.hpp"
#include "thermedge/stage_times.hpp"

namespace thermedge::detail {

// A lap is what happened since the last one, or since the clock was made:
//   THERMEDGE_TRY(clock.lap("denoise", denoiser.run(...)));
class StageClock {
 public:
  // `times` is cleared; laps are added to it.
  StageClock(StageTimes& times, std::stop_token stop)
      : times_(times), stop_(std::move(stop)), last_(Clock::now()) {
    constexpr std::size_t kMostStages = 16;
    times_.reserve(kMostStages);
    times_.clear();
  }

  // Gives `status` back; where it is good but a stop was requested, an error of kind kCancelled.
  [[nodiscard]] Status lap(std::string_view stage, Status status) {
    const Clock::time_point now = Clock::now();
    times_.push_back({stage, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
    if (status && stop_.stop_requested()) {
      return failure(ErrorCode::kCancelled, "detection was cancelled after " + std::string(stage));
    }
    return status;
  }

 private:
  using Clock = std::chrono::steady_clock;
  StageTimes& times_;
  std::stop_token stop_;
  Clock::time_point last_;
};

}  // namespace thermedge::detail
