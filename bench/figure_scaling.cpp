// Time of the presets and of their stages over the size of the frame and the number of threads.
#include <fmt/core.h>

#include <map>

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
      size.all.push_back({preset.value, threads, value_or_exit(Detector::create(options)), {}, {}});
    }
  }
  return size;
}

void run_round(Size& size) {
  for (Runs& runs : size.all) {
    value_or_exit(runs.detector.detect(size.counts));  // its memory was last touched a round ago
    const Detection& detection = *value_or_exit(runs.detector.detect(size.counts));
    for (const Stage& stage : kStages) {
      runs.stages_ms[stage.name].push_back(detection.ms.*stage.ms);
    }
    runs.total_ms.push_back(detection.ms.total());
  }
}

void add_rows(Size& size, Csv& csv) {
  for (Runs& runs : size.all) {
    std::string row = fmt::format("{},{},{},{},{:.4f}", preset_name(runs.preset()), runs.threads,
                                  size.counts.width(), size.counts.height(), median(runs.total_ms));
    for (const Stage& stage : kStages) {
      row += fmt::format(",{:.4f}", median(runs.stages_ms[stage.name]));
    }
    csv.add(row);
  }
}

}  // namespace

void measure_scaling(const BenchOptions& options) {
  std::string header = "preset,threads,width,height,ms";
  for (const Stage& stage : kStages) {
    header += fmt::format(",{}_ms", stage.name);
  }
  Csv csv(options.out + "/scaling.csv", header);
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
  for (Size& size : sizes) {
    add_rows(size, csv);
  }
  csv.write();
}

}  // namespace thermedge::bench
