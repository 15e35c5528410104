// Time of the presets, of their stages and of Gaussian + Canny over the size of the frame and the
// number of threads.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <span>
#include <string_view>

#include "csv.hpp"
#include "figures.hpp"
#include "measuring.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/sim/scene.hpp"
#include "value_or_exit.hpp"
#ifdef THERMEDGE_BENCH_OPENCV
#include "peers/opencv_canny.hpp"
#include "peers/opencv_filters.hpp"
#endif

namespace thermedge::bench {
namespace {

constexpr int kRounds = 15;
constexpr double kSigmaCounts = 20;
constexpr const char* kPeer = "Gaussian and Canny of OpenCV";

struct Runs {
  Preset preset;
  int threads;
  Detector detector;
  Detection detection;
  std::map<std::string_view, std::vector<double>> stages_ms;
  std::vector<double> total_ms;
  std::vector<double> cpu_ms;
};

struct PeerRuns {
  int threads;
  std::vector<double> total_ms;
  std::vector<double> cpu_ms;
};

// Everybody on frames of one size.
struct Size {
  Image<std::uint16_t> counts;
  std::vector<Runs> all;
  std::vector<PeerRuns> peers;  // none without OpenCV
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
          {preset.value, threads, value_or_exit(Detector::create(options)), {}, {}, {}, {}});
    }
  }
#ifdef THERMEDGE_BENCH_OPENCV
  size.peers = {{1, {}, {}}, {2, {}, {}}};
#endif
  return size;
}

// Algorithm 1, a Gaussian of 3 px and Canny: what is best for Canny at this noise.
void gaussian_and_canny([[maybe_unused]] ImageView<const std::uint16_t> counts,
                        [[maybe_unused]] int threads,
                        [[maybe_unused]] ImageView<std::uint8_t> map) {
#ifdef THERMEDGE_BENCH_OPENCV
  cv::setNumThreads(threads);
  Image<std::uint8_t> levels(counts.width(), counts.height());
  Image<std::uint8_t> smooth(counts.width(), counts.height());
  value_or_exit(scale_to_8bit(counts, {}, levels));
  opencv_blur(levels, 3, smooth);
  opencv_canny(smooth, 10, map);
#endif
}

void run_round(Size& size) {
  for (Runs& runs : size.all) {
    // Twice: its memory was last touched a round ago.
    value_or_exit(runs.detector.detect(size.counts, runs.detection));
    const double cpu_before = processor_ms();
    value_or_exit(runs.detector.detect(size.counts, runs.detection));
    runs.cpu_ms.push_back(processor_ms() - cpu_before);
    for (const StageTime& time : runs.detection.times) {
      runs.stages_ms[time.stage].push_back(time.ms);
    }
    runs.total_ms.push_back(total_ms(runs.detection.times));
  }
  for (PeerRuns& runs : size.peers) {
    Image<std::uint8_t> map(size.counts.width(), size.counts.height());
    double ms = 0;
    double cpu_ms = 0;
    for (int time = 0; time < 2; ++time) {
      const double cpu_before = processor_ms();
      const auto start = std::chrono::steady_clock::now();
      gaussian_and_canny(size.counts, runs.threads, map);
      ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
               .count();
      cpu_ms = processor_ms() - cpu_before;
    }
    runs.total_ms.push_back(ms);
    runs.cpu_ms.push_back(cpu_ms);
  }
}

// Other work on the machine makes runs longer, never shorter.
double quickest(const std::vector<double>& ms) { return *std::min_element(ms.begin(), ms.end()); }

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
    std::string row = fmt::format("{},{},{},{},{:.4f},{:.4f}", preset_name(runs.preset),
                                  runs.threads, size.counts.width(), size.counts.height(),
                                  quickest(runs.total_ms), quickest(runs.cpu_ms));
    for (const std::string_view stage : stages) {
      const auto samples = runs.stages_ms.find(stage);
      row +=
          samples == runs.stages_ms.end() ? "," : fmt::format(",{:.4f}", quickest(samples->second));
    }
    csv.add(row);
  }
  for (const PeerRuns& runs : size.peers) {
    csv.add(fmt::format("{},{},{},{},{:.4f},{:.4f}{:,>{}}", kPeer, runs.threads,
                        size.counts.width(), size.counts.height(), quickest(runs.total_ms),
                        quickest(runs.cpu_ms), "", stages.size()));
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
  std::string header = "detector,threads,width,height,ms,cpu_ms";
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
