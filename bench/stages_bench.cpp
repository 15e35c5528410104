// Time of every stage of preset `paper` on a simulated frame of the paper's camera (382x288).
#include <benchmark/benchmark.h>

#include <string>
#include <utility>

#include "thermedge/detector.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

// Reports the mean of each stage beside the time of the whole frame.
void detect(benchmark::State& state, DenoiseMethod method) {
  const auto frame = sim::render({}, 0);
  DetectorOptions options;
  options.denoise.method = method;
  options.threads = static_cast<int>(state.range(0));
  auto detector = Detector::create(options);
  if (!frame || !detector) {
    state.SkipWithError("the simulated frame or the detector could not be made");
    return;
  }
  StageTimes sum;
  for (auto _ : state) {
    const auto detection = detector->detect(frame->counts);
    benchmark::DoNotOptimize(detection);
    for (const Stage& stage : kStages) {
      sum.*stage.ms += (*detection)->ms.*stage.ms;
    }
  }
  for (const Stage& stage : kStages) {
    state.counters[std::string(stage.name) + "_ms"] =
        benchmark::Counter(sum.*stage.ms, benchmark::Counter::kAvgIterations);
  }
}

void register_all() {
  const std::pair<const char*, DenoiseMethod> methods[] = {
      {"detect/none", DenoiseMethod::kNone},
      {"detect/gaussian", DenoiseMethod::kGaussian},
      {"detect/nlm", DenoiseMethod::kNlm},
      {"detect/bm3d", DenoiseMethod::kBm3d},
  };
  for (const auto& [name, method] : methods) {
    benchmark::RegisterBenchmark(name, detect, method)
        ->Arg(1)
        ->Arg(2)
        ->ArgName("threads")
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace thermedge

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  thermedge::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
