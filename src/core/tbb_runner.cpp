#include "tbb_runner.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "thermedge/simd.hpp"

namespace thermedge {
namespace {

constexpr int kMaxThreads = 1024;

// oneTBB prints a warning where more threads than cores are asked for, unless they are allowed.
void allow_more_threads_than_cores() {
  static const oneapi::tbb::global_control allowed(
      oneapi::tbb::global_control::max_allowed_parallelism, kMaxThreads);
}

#if defined(__SANITIZE_THREAD__)
#define THERMEDGE_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define THERMEDGE_THREAD_SANITIZER
#endif
#endif

#ifdef THERMEDGE_THREAD_SANITIZER
// Repeats what oneTBB guarantees (the tasks see the caller's writes, the caller sees theirs):
// ThreadSanitizer cannot look into the library.
class Handover {
 public:
  Handover() { finished_.store(0, std::memory_order_release); }
  ~Handover() { (void)finished_.load(std::memory_order_acquire); }
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;
  void begin_task() { (void)finished_.load(std::memory_order_acquire); }
  void end_task() { finished_.fetch_add(1, std::memory_order_acq_rel); }

 private:
  std::atomic<int> finished_;
};
#else
struct Handover {
  void begin_task() {}
  void end_task() {}
};
#endif

class TbbRunner final : public ParallelRunner {
 public:
  explicit TbbRunner(int threads) : arena_(threads) {}
  void run(int count, FunctionRef task) override {
    [[maybe_unused]] Handover handover;
    const SimdTarget simd = SimdScope::current();
    arena_.execute([&] {
      oneapi::tbb::parallel_for(
          0, count, 1,
          [&](int index) {
            handover.begin_task();
            const SimdScope scope(simd);
            task(index);
            handover.end_task();
          },
          oneapi::tbb::simple_partitioner{});
    });
  }
  [[nodiscard]] int threads() const override { return arena_.max_concurrency(); }

 private:
  oneapi::tbb::task_arena arena_;
};

}  // namespace

int core_count() { return oneapi::tbb::info::default_concurrency(); }

std::unique_ptr<ParallelRunner> make_tbb_runner(int threads) {
  allow_more_threads_than_cores();
  return std::make_unique<TbbRunner>(std::min(threads, kMaxThreads));
}

}  // namespace thermedge
