// F over noise of everybody, on random scenes, on the simulator's and on prepared ones.
#include <fmt/core.h>

#include <cmath>
#include <map>

#include "csv.hpp"
#include "figures.hpp"
#include "measuring.hpp"
#include "thermedge/stages/noise.hpp"

namespace thermedge::bench {
namespace {

constexpr std::array kNoises = {0, 1, 2, 4, 8, 12, 16, 20, 25, 30};  // counts
constexpr std::uint64_t kTuningSeed = 1000;
constexpr std::uint64_t kTestSeed = 2000;

using Settings = std::map<int, std::vector<std::size_t>>;  // by noise, one for each competitor

Settings tune(const std::vector<Competitor>& all, int scenes) {
  Settings settings;
  const std::vector<CleanScene> clean = random_scenes(kTuningSeed, scenes);
  for (const int noise : kNoises) {
    const std::vector<TestFrame> frames = exposed(clean, noise, kTuningSeed);
    for (const Competitor& competitor : all) {
      settings[noise].push_back(best_setting(competitor, frames));
    }
  }
  return settings;
}

void add_rows(const std::string& set, double noise, const std::vector<Competitor>& all,
              const std::vector<std::size_t>& settings, const std::vector<TestFrame>& frames,
              Csv& csv) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Performance p = measure(all[i], settings[i], frames);
    csv.add(fmt::format("{},{},{},{},{},{},{},{:.3f}", set, noise, all[i].family, all[i].name,
                        all[i].setting_name(settings[i]), frames.size(), quality_cells(p.counts),
                        p.ms));
  }
}

// Peers get the setting for the noise next to what is measured on the frames.
void add_others(const std::string& set, const std::vector<Competitor>& all,
                const Settings& settings, const std::vector<TestFrame>& frames, Csv& csv) {
  std::vector<double> sigmas;
  sigmas.reserve(frames.size());
  for (const TestFrame& frame : frames) {
    sigmas.push_back(NoiseEstimator().measure(frame.counts).sigma_counts);
  }
  const double sigma = median(std::move(sigmas));
  int nearest = kNoises.front();
  for (const int noise : kNoises) {
    if (std::abs(noise - sigma) < std::abs(nearest - sigma)) {
      nearest = noise;
    }
  }
  add_rows(set, std::round(10 * sigma) / 10, all, settings.at(nearest), frames, csv);
}

}  // namespace

void measure_noise(const BenchOptions& options) {
  const std::vector<Competitor> all = all_competitors();
  Csv csv(options.out + "/edges.csv",
          "set,noise_counts,family,competitor,setting,frames,f,precision,recall,ms");
  const Settings settings = tune(all, (options.scenes + 1) / 2);
  const std::vector<CleanScene> clean = random_scenes(kTestSeed, options.scenes);
  for (const int noise : kNoises) {
    add_rows("random", noise, all, settings.at(noise), exposed(clean, noise, kTestSeed), csv);
  }
  for (const std::string scene : {"desk", "corridor", "office"}) {
    for (const int noise : {6, 20}) {
      std::vector<TestFrame> frames;
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        frames.push_back(simulated(scene, noise, seed));
      }
      add_others("sim:" + scene, all, settings, frames, csv);
    }
  }
  for (const std::string& directory : options.prepared) {
    for (const std::string& condition : conditions_of(directory)) {
      add_others("prepared:" + condition, all, settings,
                 prepared(directory, condition, options.scenes), csv);
    }
  }
  csv.write();
}

}  // namespace thermedge::bench
