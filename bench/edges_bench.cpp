// Edges of thermedge and of its peers on frames with known edges. Writes CSV files.
//   edges_bench OUT [--scenes N] [--only NAME] [PREPARED ...]
// NAME: noise, single_edges, false_alarms, denoisers or scaling. PREPARED: directories with
// raw/CONDITION/NAME.png (16 bits) and gt/NAME.npz.
#include <fmt/core.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
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
constexpr std::array kMeasurements = {
    Measurement{"noise", measure_noise}, Measurement{"single_edges", measure_single_edges},
    Measurement{"false_alarms", measure_false_alarms}, Measurement{"denoisers", measure_denoisers},
    Measurement{"scaling", measure_scaling}};

struct Command {
  BenchOptions options;
  std::string_view only;
};

bool is_known(std::string_view name) {
  for (const Measurement& measurement : kMeasurements) {
    if (measurement.name == name) {
      return true;
    }
  }
  return false;
}

std::optional<int> parse_count(std::string_view text) {
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size() || count < 1 || count > 1000) {
    return std::nullopt;
  }
  return count;
}

// Nothing, after a line that says why, where the command is wrong.
std::optional<Command> parse(const std::vector<std::string_view>& words) {
  Command command;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_value = i + 1 < words.size();
    if (words[i] == "--scenes") {
      const auto count = has_value ? parse_count(words[++i]) : std::nullopt;
      if (!count) {
        fmt::print(stderr, "edges_bench: --scenes: should be a number, 1..1000\n");
        return std::nullopt;
      }
      command.options.scenes = *count;
    } else if (words[i] == "--only") {
      if (!has_value || !is_known(words[++i])) {
        fmt::print(stderr,
                   "edges_bench: --only: should be noise, single_edges, false_alarms, denoisers or "
                   "scaling\n");
        return std::nullopt;
      }
      command.only = words[i];
    } else if (command.options.out.empty()) {
      command.options.out = words[i];
    } else {
      command.options.prepared.emplace_back(words[i]);
    }
  }
  if (command.options.out.empty()) {
    fmt::print(stderr, "usage: edges_bench OUT [--scenes N] [--only NAME] [PREPARED ...]\n");
    return std::nullopt;
  }
  return command;
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
  const auto command = thermedge::bench::parse({argv + 1, argv + argc});
  return command ? thermedge::bench::run(*command) : 2;
}
