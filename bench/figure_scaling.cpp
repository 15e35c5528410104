// Time of the presets and of their stages over the size of the frame and the number of threads.
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <span>
#include <string_view>

#include "csv.hpp"
#include "figures.hpp"
#include "measuring.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::bench {
namespace {

constexpr int kRounds = 7;
constexpr double kSigmaCounts = 20;

struct Runs {
  Preset preset;
  int threads;
  Detector detector;
  Detection detection;
  std::map<std::string_view, std::vector<double>> stages_ms;
  std::vector<double> total_ms;
};

// Everybody on frames of one size.
struct Size {
  Image<std::uint16_t> counts;
  std::vector<Runs> all;
};

Size prepare(int width, int height) {
  sim::SceneOptions scene;
  scene.name = "office";
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.sigma_counts = kSigmaCounts;
  Size size;
  size.counts = std::move(value_or_exit(sim::render(scene, 0)).counts);
  for (const auto& preset : kPresets) {
    for (const int threads : {1, 2}) {
      DetectorOptions options = DetectorOptions(preset.value);
      options.threads = threads;
      size.all.push_back(
          {preset.value, threads, value_or_exit(Detector::create(options)), {}, {}, {}});
    }
  }
  return size;
}

void run_round(Size& size) {
  for (Runs& runs : size.all) {
    // Twice: its memory was last touched a round ago.
    value_or_exit(runs.detector.detect(size.counts, runs.detection));
    value_or_exit(runs.detector.detect(size.counts, runs.detection));
    for (const StageTime& time : runs.detection.times) {
      runs.stages_ms[time.stage].push_back(time.ms);
    }
    runs.total_ms.push_back(total_ms(runs.detection.times));
  }
}

// The stages of all presets, each once, in the order in which they run.
std::vector<std::string_view> all_stages(const Size& size) {
  std::vector<std::string_view> stages;
  for (const Runs& runs : size.all) {
    auto place = stages.begin();
    for (const StageTime& time : runs.detection.times) {
      const auto known = std::find(stages.begin(), stages.end(), time.stage);
      place = (known != stages.end() ? known : stages.insert(place, time.stage)) + 1;
    }
  }
  return stages;
}

// A preset has no value for a stage that it does not have.
void add_rows(Size& size, std::span<const std::string_view> stages, Csv& csv) {
  for (Runs& runs : size.all) {
    std::string row = fmt::format("{},{},{},{},{:.4f}", preset_name(runs.preset), runs.threads,
                                  size.counts.width(), size.counts.height(), median(runs.total_ms));
    for (const std::string_view stage : stages) {
      const auto samples = runs.stages_ms.find(stage);
      row +=
          samples == runs.stages_ms.end() ? "," : fmt::format(",{:.4f}", median(samples->second));
    }
    csv.add(row);
  }
}

}  // namespace

void measure_scaling(const BenchOptions& options) {
  std::vector<Size> sizes;
  for (const auto& [width, height] :
       {std::pair{160, 120}, {320, 256}, {382, 288}, {640, 512}, {1024, 768}, {1920, 1080}}) {
    sizes.push_back(prepare(width, height));
  }
  for (int round = 0; round < kRounds; ++round) {  // a busy moment of the machine hits all alike
    for (Size& size : sizes) {
      run_round(size);
    }
  }
  const std::vector<std::string_view> stages = all_stages(sizes.front());
  std::string header = "preset,threads,width,height,ms";
  for (const std::string_view stage : stages) {
    header += fmt::format(",{}_ms", stage);
  }
  Csv csv(options.out + "/scaling.csv", header);
  for (Size& size : sizes) {
    add_rows(size, stages, csv);
  }
  csv.write();
}

}  // namespace thermedge::bench
