#include "thermedge/parallel_runner.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "support/runners.hpp"

namespace thermedge {
namespace {

TEST(ParallelRunner, RunsEveryTaskOnce) {
  for (const auto& runner : test::all_runners()) {
    for (const int count : {0, 1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
      runner->run(count, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
      for (const auto& c : calls) {
        EXPECT_EQ(c.load(), 1);
      }
    }
  }
}

TEST(ParallelRunner, HasTheThreadsAskedFor) {
  EXPECT_EQ(make_runner(1)->threads(), 1);
#ifdef THERMEDGE_WITH_TBB
  EXPECT_EQ(make_runner(5)->threads(), 5);
#else
  EXPECT_EQ(make_runner(5)->threads(), 1);
#endif
  EXPECT_GE(make_runner(0)->threads(), 1);
}

}  // namespace
}  // namespace thermedge
