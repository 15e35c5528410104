// Time of every stage of the presets on a simulated frame of the paper's camera (382x288).
#include <benchmark/benchmark.h>

#include <map>
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
  Detection detection;
  std::map<std::string, double> sums_ms;
  for (auto _ : state) {
    const Status status = detector->detect(frame->counts, detection);
    if (!status) {
      state.SkipWithError(status.error().message.c_str());
      return;
    }
    for (const StageTime& time : detection.times) {
      sums_ms[std::string(time.stage)] += time.ms;
    }
  }
  for (const auto& [stage, ms] : sums_ms) {
    state.counters[stage + "_ms"] = benchmark::Counter(ms, benchmark::Counter::kAvgIterations);
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
