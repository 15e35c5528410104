// How many edges are found where there are none.
#include <fmt/core.h>

#include <cmath>
#include <functional>

#include "csv.hpp"
#include "figures.hpp"
#include "noise_frames.hpp"
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

using FrameMaker = std::function<Image<std::uint16_t>(std::uint64_t seed)>;

// Mean over frames of the edges that are kept with each of these --max-false-alarms, which rise.
// Without a limit to the number of edges, the option decides on each edge alone.
std::vector<double> false_edges(Preset preset, const std::vector<double>& most,
                                const FrameMaker& make, int frames) {
  DetectorOptions options = DetectorOptions(preset);
  if (preset != Preset::kPaper) {
    options.selection.max_false_alarms = most.back();
  }
  Detector detector = value_or_exit(Detector::create(options));
  std::vector<double> edges(most.size());
  for (int frame = 0; frame < frames; ++frame) {
    const Detection found =
        value_or_exit(detector.detect(make(9000 + static_cast<unsigned>(frame))));
    for (std::size_t i = 0; i < most.size(); ++i) {
      for (const Edge& edge : found.edges.kept_edges()) {
        const bool dropped = i + 1 < most.size() && edge.log10_nfa > std::log10(most[i]);
        edges[i] += dropped ? 0 : 1.0 / frames;
      }
    }
  }
  return edges;
}

void measure_levels(int frames, const std::string& path) {
  constexpr double kDefault = 0.1;
  Csv csv(path, "preset,frame,noise_counts,max_false_alarms,frames,edges_per_frame");
  const auto add = [&](Preset preset, const Kind& kind, double sigma,
                       const std::vector<double>& most, int count) {
    const auto edges = false_edges(
        preset, most, [&](std::uint64_t seed) { return empty_frame(kind.kind, sigma, seed); },
        count);
    for (std::size_t i = 0; i < most.size(); ++i) {
      csv.add(fmt::format("{},{},{},{},{},{:.4f}", preset_name(preset), kind.name, sigma,
                          preset == Preset::kPaper ? 0 : most[i], count, edges[i]));
    }
  };
  for (const auto& preset : kPresets) {
    for (const Kind& kind : kKinds) {
      for (const double sigma : {1.0, 3.0, 10.0, 30.0, 100.0}) {
        add(preset.value, kind, sigma, {kDefault}, frames);
      }
    }
  }
  for (const Preset preset : {Preset::kRobust, Preset::kFast}) {
    for (const Kind& kind : kKinds) {
      add(preset, kind, 20, {0.01, 0.03, 0.1, 0.3, 1.0}, 2 * frames);
    }
  }
  csv.write();
}

void measure_kinds(int frames, const std::string& path) {
  const std::vector<double> most = {0.01, 0.1, 1};
  Csv csv(path, "preset,noise,max_false_alarms,frames,edges_per_frame");
  for (const Preset preset : {Preset::kRobust, Preset::kFast}) {
    for (const NoiseKind& kind : kNoiseKinds) {
      const auto edges = false_edges(preset, most, kind.make, frames);
      for (std::size_t i = 0; i < most.size(); ++i) {
        csv.add(fmt::format("{},\"{}\",{},{},{:.4f}", preset_name(preset), kind.name, most[i],
                            frames, edges[i]));
      }
    }
  }
  csv.write();
}

}  // namespace

void measure_false_alarms(const BenchOptions& options) {
  const int frames = 5 * options.scenes;
  measure_levels(frames, options.out + "/false_alarms.csv");
  measure_kinds(frames, options.out + "/noise_kinds.csv");
}

}  // namespace thermedge::bench
