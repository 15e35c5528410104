#include "stage_clock.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "try.hpp"

namespace thermedge::detail {
namespace {

TEST(StageClock, ALapIsTheTimeSinceTheOneBefore) {
  StageTimes times{{"of the frame before", 7.0}};
  const auto begin = std::chrono::steady_clock::now();
  StageClock clock(times, {});
  EXPECT_TRUE(times.empty());
  std::this_thread::sleep_for(std::chrono::milliseconds(4));
  EXPECT_TRUE(clock.lap("slow", {}));
  EXPECT_TRUE(clock.lap("fast", {}));
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].stage, "slow");
  EXPECT_EQ(times[1].stage, "fast");
  EXPECT_GE(times[0].ms, 4);
  EXPECT_GE(times[1].ms, 0);
  EXPECT_EQ(total_ms(times), times[0].ms + times[1].ms);
  EXPECT_LE(total_ms(times), passed.count());
  EXPECT_EQ(total_ms({}), 0);
}

TEST(StageClock, HandsAnErrorOnAndStillTimesTheStage) {
  std::stop_source source;
  StageTimes times;
  StageClock clock(times, source.get_token());
  EXPECT_EQ(clock.lap("broken", failure(ErrorCode::kIo, "why")).error().message, "why");
  // The error says more than that a stop was asked for as well.
  source.request_stop();
  EXPECT_EQ(clock.lap("broken", failure(ErrorCode::kIo, "why")).error().code, ErrorCode::kIo);
  EXPECT_EQ(times.size(), 2U);
}

TEST(StageClock, StopsAfterTheStageInWhichAStopWasRequested) {
  std::stop_source source;
  StageTimes times;
  StageClock clock(times, source.get_token());
  EXPECT_TRUE(clock.lap("first", {}));
  source.request_stop();
  const Status status = clock.lap("second", {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(status.error().message, "detection was cancelled after second");
}

TEST(Try, ReturnsTheFirstErrorAndSkipsTheRest) {
  for (const int failing : {0, 1, 2}) {
    int calls = 0;
    const auto step = [&](int number) -> Result<int> {
      ++calls;
      if (number == failing) {
        return failure(ErrorCode::kBadData, "step " + std::to_string(number), "option");
      }
      return number;
    };
    const auto both = [&]() -> Status {
      THERMEDGE_TRY(step(0));
      THERMEDGE_TRY(step(1));
      return {};
    };
    const Status status = both();
    EXPECT_EQ(status.has_value(), failing == 2);
    EXPECT_EQ(calls, failing == 0 ? 1 : 2);
    if (!status) {
      EXPECT_EQ(status.error().message, "step " + std::to_string(failing));
      EXPECT_EQ(status.error().option, "option");
    }
  }
}

}  // namespace
}  // namespace thermedge::detail
