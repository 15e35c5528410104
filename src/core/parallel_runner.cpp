#include "thermedge/parallel_runner.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace thermedge {
namespace {

constexpr int kMaxThreads = 1024;

class SerialRunner final : public ParallelRunner {
 public:
  void run(int count, FunctionRef task) override {
    for (int i = 0; i < count; ++i) {
      task(i);
    }
  }
  [[nodiscard]] int threads() const override { return 1; }
};

// oneTBB prints a warning where more threads than cores are asked for, unless they are allowed.
void allow_more_threads_than_cores() {
  static const oneapi::tbb::global_control allowed(
      oneapi::tbb::global_control::max_allowed_parallelism, kMaxThreads);
}

class TbbRunner final : public ParallelRunner {
 public:
  explicit TbbRunner(int threads) : arena_(threads) {}
  void run(int count, FunctionRef task) override {
    // The atomics repeat what oneTBB guarantees (the caller's writes are seen by the tasks, theirs
    // by the caller): ThreadSanitizer cannot look into the library.
    std::atomic<int> finished;
    finished.store(0, std::memory_order_release);
    arena_.execute([&] {
      oneapi::tbb::parallel_for(
          0, count, 1,
          [&](int index) {
            (void)finished.load(std::memory_order_acquire);
            task(index);
            finished.fetch_add(1, std::memory_order_acq_rel);
          },
          oneapi::tbb::simple_partitioner{});
    });
    (void)finished.load(std::memory_order_acquire);
  }
  [[nodiscard]] int threads() const override { return arena_.max_concurrency(); }

 private:
  oneapi::tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<ParallelRunner> make_runner(int threads) {
  const int count = threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
  if (count == 1) {
    return std::make_unique<SerialRunner>();
  }
  allow_more_threads_than_cores();
  return std::make_unique<TbbRunner>(std::min(count, kMaxThreads));
}

}  // namespace thermedge
