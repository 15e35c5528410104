#include "thermedge/parallel.hpp"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

namespace thermedge {
namespace {

class SerialRunner final : public Runner {
 public:
  void run(int count, TaskRef task) override {
    for (int i = 0; i < count; ++i) {
      task(i);
    }
  }
  [[nodiscard]] int threads() const override { return 1; }
};

class TbbRunner final : public Runner {
 public:
  explicit TbbRunner(int threads) : arena_(threads) {}
  void run(int count, TaskRef task) override {
    arena_.execute([&] {
      oneapi::tbb::parallel_for(
          0, count, 1, [&](int index) { task(index); }, oneapi::tbb::simple_partitioner{});
    });
  }
  [[nodiscard]] int threads() const override { return arena_.max_concurrency(); }

 private:
  oneapi::tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<Runner> make_runner(int threads) {
  const int count = threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
  if (count == 1) {
    return std::make_unique<SerialRunner>();
  }
  return std::make_unique<TbbRunner>(count);
}

}  // namespace thermedge
