// F of everybody in the conditions in which users' frames come.
#include <fmt/core.h>

#include "csv.hpp"
#include "figures.hpp"
#include "measuring.hpp"
#include "processing.hpp"
#include "scene_conditions.hpp"
#include "thermedge/parallel_runner.hpp"

namespace thermedge::bench {
namespace {

constexpr std::uint64_t kTuningSeed = 1000;
constexpr std::uint64_t kTestSeed = 2000;

std::vector<TestFrame> scenes_under(const SceneCondition& condition, std::uint64_t first_seed,
                                    int count) {
  std::vector<TestFrame> frames(static_cast<std::size_t>(count));
  make_runner(0)->run(count, [&](int i) {
    frames[static_cast<std::size_t>(i)] =
        scene_under(condition, first_seed + static_cast<unsigned>(i));
  });
  return frames;
}

// thermedge finds bad pixels itself.
void remove_outliers(double sigma_counts, std::vector<TestFrame>& frames) {
  for (TestFrame& frame : frames) {
    frame.counts = without_outliers(frame.counts, sigma_counts);
  }
}

}  // namespace

void measure_conditions(const BenchOptions& options) {
  Csv csv(
      options.out + "/conditions.csv",
      "condition,range_counts,noise_counts,family,competitor,setting,frames,f,precision,recall");
  for (const SceneCondition& condition : kSceneConditions) {
    const double sigma = pixel_sigma(condition);
    auto tuning = scenes_under(condition, kTuningSeed, (options.scenes + 1) / 2);
    remove_outliers(sigma, tuning);
    auto test = scenes_under(condition, kTestSeed, options.scenes);
    bool for_peers = false;
    for (const Competitor& competitor : competitors_in_noise(sigma)) {
      if (competitor.family != "thermedge" && !for_peers) {
        remove_outliers(sigma, test);
        for_peers = true;
      }
      const std::size_t setting = best_setting(competitor, tuning);
      csv.add(fmt::format("\"{}\",{},{},{},{},{},{},{}", condition.name, condition.range_counts,
                          condition.sigma_counts, competitor.family, competitor.name,
                          competitor.setting_name(setting), test.size(),
                          quality_cells(measure(competitor, setting, test).counts)));
    }
  }
  csv.write();
}

}  // namespace thermedge::bench
