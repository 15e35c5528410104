// Time of every stage of the presets on a simulated frame of the paper's camera (382x288).
#include <benchmark/benchmark.h>

#include <string>
#include <utility>
#include <vector>

#include "thermedge/detector.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

// Reports the mean of each stage beside the time of the whole frame.
void detect(benchmark::State& state, DetectorOptions options) {
  const auto frame = sim::render({}, 0);
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
      sum.*stage.ms += detection->ms.*stage.ms;
    }
  }
  for (const Stage& stage : kStages) {
    state.counters[std::string(stage.name) + "_ms"] =
        benchmark::Counter(sum.*stage.ms, benchmark::Counter::kAvgIterations);
  }
}

void register_all() {
  std::vector<std::pair<std::string, DetectorOptions>> settings;
  for (const auto& preset : kPresets) {
    settings.emplace_back(preset.name, DetectorOptions(preset.value));
  }
  for (const auto& method : kDenoiseMethods) {
    DetectorOptions options = DetectorOptions(Preset::kPaper);
    options.denoise.method = method.value;
    settings.emplace_back("paper/" + std::string(method.name), options);
  }
  for (const auto& [name, options] : settings) {
    benchmark::RegisterBenchmark(("detect/" + name).c_str(), detect, options)
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
