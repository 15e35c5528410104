// Runners that make order bugs reproducible.
#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "thermedge/parallel_runner.hpp"

namespace thermedge::test {

// Runs the tasks on one thread in a seeded random order.
class ShuffledRunner final : public ParallelRunner {
 public:
  explicit ShuffledRunner(unsigned seed) : random_(seed) {}
  void run(int count, FunctionRef task) override {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random_);
    for (const int index : order) {
      task(index);
    }
  }
  [[nodiscard]] int threads() const override { return 1; }

 private:
  std::mt19937 random_;
};

// The runners under which a parallel stage must give the same bits: 1, 2 and 5 threads, shuffled.
inline std::vector<std::unique_ptr<ParallelRunner>> all_runners() {
  std::vector<std::unique_ptr<ParallelRunner>> runners;
  for (const int threads : {1, 2, 5}) {
    runners.push_back(make_runner(threads));
  }
  runners.push_back(std::make_unique<ShuffledRunner>(7));
  return runners;
}

}  // namespace thermedge::test
