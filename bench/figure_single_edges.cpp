// How faint an edge may be before it is missed.
#include <fmt/core.h>

#include <cmath>
#include <functional>

#include "csv.hpp"
#include "figures.hpp"
#include "measuring.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/stages/noise.hpp"
#include "thermedge/stages/preprocessor.hpp"

namespace thermedge::bench {
namespace {

constexpr double kSigmaCounts = 20;
constexpr double kReachPx = 2;
constexpr double kFoundShare = 0.7;
constexpr double kFalseContours = 0.1;  // a frame
constexpr int kEmptyFrames = 40;        // that peers are set on

// Without dead pixels and stripes, as our presets remove them: peers would find those first.
Image<std::uint16_t> corrected(ImageView<const std::uint16_t> counts) {
  Preprocessor preprocessor({}, {.remove = true}, {}, true);
  Corrections corrections;
  const auto view = preprocessor.run(counts, *make_runner(1), corrections);
  Image<std::uint16_t> copy(view.width(), view.height());
  copy_pixels(view, copy.view());
  return copy;
}

struct Entrant {
  std::string name;
  std::string setting;
  bool wants_corrected;
  WholeDetector run;
};

double false_contours(const Competitor& peer, std::size_t setting,
                      const std::vector<Image<std::uint16_t>>& frames) {
  std::size_t contours = 0;
  for (const auto& frame : frames) {
    Image<std::uint8_t> map(frame.width(), frame.height());
    peer.run(setting, frame, map);
    contours += count_fragments(map).fragments;
  }
  return static_cast<double>(contours) / static_cast<double>(frames.size());
}

// For each front, the first finder that is quiet enough on frames of noise.
void add_quiet_settings(const Competitor& peer, const std::vector<Image<std::uint16_t>>& frames,
                        std::vector<Entrant>& entrants) {
  for (std::size_t front = 0; front < peer.fronts.size(); ++front) {
    for (std::size_t finder = 0; finder < peer.finders.size(); ++finder) {
      const std::size_t setting = front * peer.finders.size() + finder;
      if (false_contours(peer, setting, frames) <= kFalseContours) {
        entrants.push_back({peer.name, peer.setting_name(setting), true,
                            [peer, setting](const Frame& frame, ImageView<std::uint8_t> map) {
                              peer.run(setting, frame, map);
                            }});
        break;
      }
    }
  }
}

std::vector<Entrant> entrants() {
  std::vector<Entrant> all;
  for (const Preset preset : {Preset::kRobust, Preset::kFast}) {
    all.push_back({"thermedge " + std::string(preset_name(preset)), "defaults", false,
                   thermedge_detector(DetectorOptions(preset))});
  }
  std::vector<Image<std::uint16_t>> frames;
  for (std::uint64_t seed = 1; seed <= kEmptyFrames; ++seed) {
    frames.push_back(corrected(empty_frame(Emptiness::kStripes, kSigmaCounts, 7000 + seed)));
  }
  for (const Competitor& peer : peers_for_detection()) {
    add_quiet_settings(peer, frames, all);
  }
  return all;
}

bool is_found(ImageView<const std::uint8_t> map, const std::vector<eval::Point>& edge) {
  const eval::CurveFrame pixels = eval::pixels_as_curves(map);
  const eval::NearestOnCurves found(pixels.curves, kReachPx);
  std::size_t near = 0;
  for (const eval::Point point : edge) {
    near += found.is_near(point) ? 1 : 0;
  }
  return static_cast<double>(near) >= kFoundShare * static_cast<double>(edge.size());
}

}  // namespace

void measure_single_edges(const BenchOptions& options) {
  constexpr std::array kLengths = {16, 32, 64, 128, 200};
  constexpr std::array kContrasts = {0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.4, 2.0, 3.0};
  const int trials = 3 * options.scenes;
  const std::vector<Entrant> all = entrants();
  Csv csv(options.out + "/single_edges.csv",
          "competitor,setting,length_px,contrast_sigmas,trials,found");
  for (const int length : kLengths) {
    for (const double contrast : kContrasts) {
      std::vector<int> found(all.size());
      for (int trial = 0; trial < trials; ++trial) {
        const auto seed = static_cast<std::uint64_t>(1000 * length + trial);
        const SingleEdge edge = single_edge(length, trial % 2 == 1, contrast * kSigmaCounts, seed);
        const Image<std::uint16_t> counts = expose(edge.clean, {kSigmaCounts}, seed);
        const Image<std::uint16_t> corrected_counts = corrected(counts);
        for (std::size_t i = 0; i < all.size(); ++i) {
          Image<std::uint8_t> map(counts.width(), counts.height());
          all[i].run(all[i].wants_corrected ? corrected_counts : counts, map);
          found[i] += is_found(map, edge.points) ? 1 : 0;
        }
      }
      for (std::size_t i = 0; i < all.size(); ++i) {
        csv.add(fmt::format("{},{},{},{},{},{}", all[i].name, all[i].setting, length, contrast,
                            trials, found[i]));
      }
    }
  }
  csv.write();
}

}  // namespace thermedge::bench
