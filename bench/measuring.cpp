#include "measuring.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <ctime>

#include "value_or_exit.hpp"

namespace thermedge::bench {
namespace {

eval::MatchCounts matched(ImageView<const std::uint8_t> map, const eval::TruthMaps& truth) {
  constexpr std::array kAnyEdge = {1};
  return value_or_exit(eval::count_matches(map, truth, kAnyEdge, {})).front();
}

// One frame with every setting; each front runs once.
std::vector<eval::MatchCounts> with_all_settings(const Competitor& competitor,
                                                 const TestFrame& frame) {
  std::vector<eval::MatchCounts> counts;
  Image<std::uint8_t> levels(frame.counts.width(), frame.counts.height());
  Image<std::uint8_t> map(frame.counts.width(), frame.counts.height());
  for (const NamedDetector& whole : competitor.wholes) {
    whole.run(frame.frame(), map);
    counts.push_back(matched(map, frame.truth));
  }
  for (const FrontEnd& front : competitor.fronts) {
    front.run(frame.counts, levels);
    for (const Finder& finder : competitor.finders) {
      finder.run(levels, map);
      counts.push_back(matched(map, frame.truth));
    }
  }
  return counts;
}

eval::TruthMaps copy(const eval::TruthMaps& truth) {
  eval::TruthMaps result;
  for (const auto& map : truth.annotators) {
    result.annotators.push_back(map.clone());
  }
  for (const auto& map : truth.accepted) {
    result.accepted.push_back(map.clone());
  }
  return result;
}

}  // namespace

Performance measure(const Competitor& competitor, std::size_t setting,
                    const std::vector<TestFrame>& frames) {
  Performance performance;
  std::vector<double> ms;
  for (const TestFrame& frame : frames) {
    Image<std::uint8_t> map(frame.counts.width(), frame.counts.height());
    if (ms.empty()) {
      competitor.run(setting, frame.frame(), map);  // memory is taken and caches are filled
    }
    const double start = processor_ms();
    competitor.run(setting, frame.frame(), map);
    ms.push_back(processor_ms() - start);
    performance.counts += matched(map, frame.truth);
  }
  performance.ms = median(std::move(ms));
  return performance;
}

std::size_t best_setting(const Competitor& competitor, const std::vector<TestFrame>& frames) {
  if (competitor.settings() == 1) {
    return 0;
  }
  std::vector<std::vector<eval::MatchCounts>> of_frames(frames.size());
  make_runner(0)->run(static_cast<int>(frames.size()), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    of_frames[index] = with_all_settings(competitor, frames[index]);
  });
  std::vector<eval::MatchCounts> sums(competitor.settings());
  for (const auto& counts : of_frames) {
    for (std::size_t setting = 0; setting < sums.size(); ++setting) {
      sums[setting] += counts[setting];
    }
  }
  const auto best = std::max_element(sums.begin(), sums.end(), [](const auto& a, const auto& b) {
    return a.f_measure() < b.f_measure();
  });
  return static_cast<std::size_t>(best - sums.begin());
}

std::string quality_cells(const eval::MatchCounts& counts) {
  return fmt::format("{:.4f},{:.4f},{:.4f}", counts.f_measure(), counts.precision(),
                     counts.recall());
}

std::vector<CleanScene> random_scenes(std::uint64_t first_seed, int count) {
  std::vector<CleanScene> scenes(static_cast<std::size_t>(count));
  make_runner(0)->run(count, [&](int i) {
    scenes[static_cast<std::size_t>(i)] = random_scene(first_seed + static_cast<unsigned>(i));
  });
  return scenes;
}

std::vector<TestFrame> exposed(const std::vector<CleanScene>& scenes, double sigma_counts,
                               std::uint64_t seed) {
  std::vector<TestFrame> frames;
  frames.reserve(scenes.size());
  for (const CleanScene& scene : scenes) {
    frames.push_back({expose(scene, sigma_counts, seed + frames.size()), copy(scene.truth)});
  }
  return frames;
}

double processor_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace thermedge::bench
