// The choice of instruction set: by name, for a scope, on the threads of a runner.
#include "thermedge/simd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "simd_dispatch.hpp"
#include "support/runners.hpp"

namespace thermedge {
namespace {

std::string current() { return SimdScope::current().name(); }

TEST(SimdTarget, IsNamedInAnyCase) {
  const auto known = simd_targets();
  ASSERT_FALSE(known.empty());
  for (const std::string& name : known) {
    std::string small = name;
    std::transform(small.begin(), small.end(), small.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    EXPECT_EQ(SimdTarget::named(name)->name(), name);
    EXPECT_EQ(SimdTarget::named(small)->name(), name);
  }
  EXPECT_EQ(std::set<std::string>(known.begin(), known.end()).size(), known.size());
}

TEST(SimdTarget, IsTheBestWhereNoneIsNamed) {
  EXPECT_EQ(SimdTarget().name(), simd_targets().front());
  EXPECT_EQ(SimdTarget::named("auto")->name(), simd_targets().front());
  EXPECT_EQ(SimdTarget::named("Auto")->name(), simd_targets().front());
}

TEST(SimdTarget, ThatIsUnknownIsAnErrorThatListsTheOthers) {
  std::string known = "auto";
  for (const std::string& name : simd_targets()) {
    known += ", " + name;
  }
  for (const std::string name : {"", "avx", "SSE9", " auto"}) {
    const auto target = SimdTarget::named(name);
    ASSERT_FALSE(target) << name;
    EXPECT_EQ(target.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(target.error().message, "SIMD target '" + name + "': this machine has " + known);
  }
}

TEST(SimdScope, NestsAndGoesBack) {
  const auto known = simd_targets();
  const std::string& best = known.front();
  const std::string& worst = known.back();
  EXPECT_EQ(current(), best);
  {
    const SimdScope outer(*SimdTarget::named(worst));
    EXPECT_EQ(current(), worst);
    {
      const SimdScope inner(SimdTarget{});
      EXPECT_EQ(current(), best);
    }
    EXPECT_EQ(current(), worst);
  }
  EXPECT_EQ(current(), best);
}

TEST(SimdScope, EachTargetHasKernelsOfItsOwn) {
  std::set<std::size_t> indices;
  for (const std::string& name : simd_targets()) {
    const SimdScope scope(*SimdTarget::named(name));
    indices.insert(detail::simd_table_index());
  }
  EXPECT_EQ(indices.size(), simd_targets().size());
}

TEST(SimdScope, IsOfOneThread) {
  const SimdScope scope(*SimdTarget::named(simd_targets().back()));
  std::string of_other;
  std::thread([&] { of_other = current(); }).join();
  EXPECT_EQ(of_other, simd_targets().front());
}

TEST(SimdScope, IsHandedOnToTheTasksOfRunners) {
  for (const auto& runner : test::all_runners()) {
    for (const std::string& name : simd_targets()) {
      const SimdScope scope(*SimdTarget::named(name));
      std::vector<std::string> seen(16);
      runner->run(16, [&](int i) {
        seen[static_cast<std::size_t>(i)] = current();
        std::this_thread::sleep_for(std::chrono::microseconds(20));
      });
      EXPECT_EQ(seen, std::vector<std::string>(16, name));
    }
    EXPECT_EQ(current(), simd_targets().front());
  }
}

}  // namespace
}  // namespace thermedge
