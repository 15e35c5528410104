#include "thermedge/parallel_runner.hpp"

#ifdef THERMEDGE_WITH_TBB
#include "tbb_runner.hpp"
#endif

namespace thermedge {
namespace {

class SerialRunner final : public ParallelRunner {
 public:
  void run(int count, FunctionRef task) override {
    for (int i = 0; i < count; ++i) {
      task(i);
    }
  }
  [[nodiscard]] int threads() const override { return 1; }
};

}  // namespace

std::unique_ptr<ParallelRunner> make_runner([[maybe_unused]] int threads) {
#ifdef THERMEDGE_WITH_TBB
  const int count = threads > 0 ? threads : core_count();
  if (count > 1) {
    return make_tbb_runner(count);
  }
#endif
  return std::make_unique<SerialRunner>();
}

}  // namespace thermedge
