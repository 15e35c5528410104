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

std::vector<Runs> all_runs() {
  std::vector<Runs> all;
  for (const auto& preset : kPresets) {
    for (const int threads : {1, 2}) {
      DetectorOptions options = preset_options(preset.value);
      options.threads = threads;
      all.push_back({preset.value, threads, must(Detector::create(options)), {}, {}});
    }
  }
  return all;
}

void run_round(ImageView<const std::uint16_t> counts, bool counted, std::vector<Runs>& all) {
  for (Runs& runs : all) {
    const Detection& detection = *must(runs.detector.detect(counts));
    if (!counted) {
      continue;
    }
    for (const Stage& stage : kStages) {
      runs.stages_ms[stage.name].push_back(detection.ms.*stage.ms);
    }
    runs.total_ms.push_back(detection.ms.total());
  }
}

}  // namespace

void measure_scaling(const BenchOptions& options) {
  std::string header = "preset,threads,width,height,ms";
  for (const Stage& stage : kStages) {
    header += fmt::format(",{}_ms", stage.name);
  }
  Csv csv(options.out + "/scaling.csv", header);
  for (const auto& [width, height] :
       {std::pair{160, 120}, {320, 256}, {382, 288}, {640, 512}, {1024, 768}, {1920, 1080}}) {
    sim::SceneOptions scene;
    scene.name = "office";
    scene.camera.width = width;
    scene.camera.height = height;
    scene.camera.sigma_counts = kSigmaCounts;
    const Image<std::uint16_t> counts = std::move(must(sim::render(scene, 0)).counts);
    std::vector<Runs> all = all_runs();
    for (int round = 0; round <= kRounds; ++round) {  // the first one takes memory
      run_round(counts, round > 0, all);
    }
    for (Runs& runs : all) {
      std::string row = fmt::format("{},{},{},{},{:.4f}", preset_name(runs.preset), runs.threads,
                                    width, height, median(runs.total_ms));
      for (const Stage& stage : kStages) {
        row += fmt::format(",{:.4f}", median(runs.stages_ms[stage.name]));
      }
      csv.add(row);
    }
  }
  csv.write();
}

}  // namespace thermedge::bench
