// Options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/options.hpp"

namespace thermedge::cli {

// The names in a list of options.hpp, for CLI::IsMember.
template <class E, std::size_t N>
[[nodiscard]] std::vector<std::string> names_of(const std::array<EnumName<E>, N>& list) {
  std::vector<std::string> names;
  names.reserve(N);
  for (const EnumName<E>& entry : list) {
    names.emplace_back(entry.name);
  }
  return names;
}

// --threads, --quiet, --json-log.
struct RunOptions {
  int threads = 0;
  bool quiet = false;
  bool json_log = false;

  void add_to(CLI::App& app);
  [[nodiscard]] Console report() const { return {quiet, json_log}; }
};

// --mask, --invalid: which pixels of the frames are no measurement.
struct ValidityInput {
  std::string mask;                   // file
  std::vector<std::uint16_t> counts;  // that mean no measurement

  [[nodiscard]] bool empty() const { return mask.empty() && counts.empty(); }
};

// INPUT..., -o, --raw-size, --raw-format, --simd, and those above.
struct CommonOptions : RunOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::string raw_size;
  std::string raw_format = "gray16le";
  std::string simd = "auto";
  ValidityInput validity;

  void add_to(CLI::App& app);
  // --mask and --invalid, of commands that measure on frames.
  void add_validity_to(CLI::App& app);
  // Checks what the parser can't. Failures are usage errors.
  [[nodiscard]] Result<io::SourceOptions> prepare() const;
};

// --config, --set, --dump-config.
struct ConfigOptions {
  std::string file;
  std::vector<std::string> settings;
  bool dump = false;

  void add_to(CLI::App& app);
  // The file, then --set, each over what was before. `choice`: whether the file may choose the
  // preset.
  [[nodiscard]] Status apply(io::PresetChoice choice, DetectorOptions& options) const;
  [[nodiscard]] Status apply(FrameDenoiserOptions& options) const;
};

// --sigma auto|COUNTS: 0 stands for auto.
[[nodiscard]] Result<double> parse_sigma(const std::string& text);

// Calls `handle(frame)` for each frame of the inputs; an error (of reading or handling) is reported
// and the next frame follows. Returns the exit code.
[[nodiscard]] int for_each_frame(const CommonOptions& common, const io::SourceOptions& source,
                                 Console& report,
                                 const std::function<Status(const io::SourceFrame&)>& handle);

// Where results of several frames go: DIR/<kind>/<stem><ending>, DIR/<stem><ending> where kind
// is empty, or a folder for each frame, DIR/<stem>/<name>. Makes the directories; stems that occur
// twice in a run get "_2", "_3" ... so that no result of the run is lost.
class OutputDirectory {
 public:
  explicit OutputDirectory(std::string directory) : directory_(std::move(directory)) {}
  // Once per frame, before the paths.
  void begin_frame(const std::string& stem);
  [[nodiscard]] Result<std::string> path(const std::string& kind, const std::string& ending);
  [[nodiscard]] Result<std::string> path_in_folder(const std::string& name);

 private:
  std::string directory_;
  std::vector<std::string> used_;  // sorted
  std::string stem_;
};

// The error of a second frame where `output` names one file.
[[nodiscard]] tl::unexpected<Error> only_one_frame(const std::string& output);

// "--write a,b" split at the commas.
[[nodiscard]] std::vector<std::string> split_list(const std::string& list);

}  // namespace thermedge::cli
