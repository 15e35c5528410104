// Edges of thermedge and of its peers on frames with known edges. Writes CSV files; --help tells
// how to call it.
#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "figures.hpp"
#ifdef THERMEDGE_BENCH_OPENCV
#include <opencv2/core/utility.hpp>
#endif

namespace thermedge::bench {
namespace {

struct Measurement {
  std::string_view name;
  void (*run)(const BenchOptions& options);
};
constexpr std::array kMeasurements = {Measurement{"noise", measure_noise},
                                      Measurement{"conditions", measure_conditions},
                                      Measurement{"single_edges", measure_single_edges},
                                      Measurement{"false_alarms", measure_false_alarms},
                                      Measurement{"denoisers", measure_denoisers},
                                      Measurement{"scaling", measure_scaling}};

struct Command {
  BenchOptions options;
  std::string only;
};

std::vector<std::string> measurement_names() {
  std::vector<std::string> names;
  for (const Measurement& measurement : kMeasurements) {
    names.emplace_back(measurement.name);
  }
  return names;
}

void declare(CLI::App& app, Command& command) {
  app.add_option("OUT", command.options.out, "directory of the CSV files")->required();
  app.add_option("PREPARED", command.options.prepared,
                 "directories with raw/CONDITION/NAME.png (16 bits) and gt/NAME.npz");
  app.add_option("--scenes", command.options.scenes, "random scenes")->check(CLI::Range(1, 1000));
  app.add_option("--only", command.only, "a single measurement")
      ->check(CLI::IsMember(measurement_names()));
}

int run(const Command& command) {
  for (const std::string& directory : command.options.prepared) {
    if (!std::filesystem::is_directory(directory + "/raw") ||
        !std::filesystem::is_directory(directory + "/gt")) {
      fmt::print(stderr, "edges_bench: {}: should hold the directories raw and gt\n", directory);
      return 1;
    }
  }
#ifdef THERMEDGE_BENCH_OPENCV
  cv::setNumThreads(1);
#else
  fmt::print("OpenCV (libopencv-dev) was not there when this was built: its rows are left out\n");
#endif
  for (const Measurement& measurement : kMeasurements) {
    if (command.only.empty() || command.only == measurement.name) {
      measurement.run(command.options);
    }
  }
  return 0;
}

}  // namespace
}  // namespace thermedge::bench

int main(int argc, char** argv) {
  CLI::App app("Edges of thermedge and of its peers on frames with known edges");
  thermedge::bench::Command command;
  thermedge::bench::declare(app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return thermedge::bench::run(command);
}
