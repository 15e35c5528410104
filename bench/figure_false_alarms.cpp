// How many edges are found where there are none.
#include <fmt/core.h>

#include "csv.hpp"
#include "figures.hpp"
#include "test_frames.hpp"
#include "thermedge/detector.hpp"
#include "value_or_exit.hpp"

namespace thermedge::bench {
namespace {

struct Kind {
  Emptiness kind;
  const char* name;
};
constexpr std::array kKinds = {Kind{Emptiness::kPlain, "plain"},
                               Kind{Emptiness::kStripes, "stripes"},
                               Kind{Emptiness::kVignette, "stripes and vignette"}};

// Mean over frames.
double false_edges(const DetectorOptions& options, Emptiness kind, double sigma, int frames) {
  Detector detector = value_or_exit(Detector::create(options));
  std::size_t edges = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const auto counts = empty_frame(kind, sigma, 9000 + static_cast<unsigned>(frame));
    edges += value_or_exit(detector.detect(counts)).edges.kept;
  }
  return static_cast<double>(edges) / frames;
}

}  // namespace

void measure_false_alarms(const BenchOptions& options) {
  const int frames = 5 * options.scenes;
  Csv csv(options.out + "/false_alarms.csv",
          "preset,frame,noise_counts,max_false_alarms,frames,edges_per_frame");
  const auto add = [&](const DetectorOptions& detector, const Kind& kind, double sigma, int count) {
    csv.add(fmt::format("{},{},{},{},{},{:.4f}", preset_name(detector.preset()), kind.name, sigma,
                        detector.selection.max_false_alarms, count,
                        false_edges(detector, kind.kind, sigma, count)));
  };
  for (const auto& preset : kPresets) {
    for (const Kind& kind : kKinds) {
      for (const double sigma : {1.0, 3.0, 10.0, 30.0, 100.0}) {
        add(DetectorOptions(preset.value), kind, sigma, frames);
      }
    }
  }
  for (const Preset preset : {Preset::kRobust, Preset::kFast}) {
    for (const double most : {0.01, 0.03, 0.1, 0.3, 1.0}) {
      DetectorOptions detector = DetectorOptions(preset);
      detector.selection.max_false_alarms = most;
      for (const Kind& kind : kKinds) {
        add(detector, kind, 20, 2 * frames);
      }
    }
  }
  csv.write();
}

}  // namespace thermedge::bench
