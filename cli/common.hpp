// Options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "output.hpp"
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
  std::optional<int> threads;  // as given; 0: one per core
  bool quiet = false;
  bool json_log = false;

  void add_to(CLI::App& app);
  [[nodiscard]] Console report() const { return {quiet, json_log}; }
};

// --mask, --invalid: which pixels of the frames are no measurement.
struct ValidityInput {
  std::string mask;            // file
  std::vector<double> counts;  // that mean no measurement; of float frames values

  [[nodiscard]] bool empty() const { return mask.empty() && counts.empty(); }
};

// A flag that sets an option of sources: --raw-size for source.raw_size.
struct SourceFlag {
  const char* flag;
  const char* option;  // of io::set_source_option
  const char* type;
  const char* help;
};
inline constexpr std::array kSourceFlags = {
    SourceFlag{"--crop", "crop", "PART",
               "part of each frame: X,Y,WIDTH,HEIGHT in px, top-half or bottom-half"},
    SourceFlag{"--byte-order", "byte_order", "ORDER",
               "of samples in files: little, big or swapped, whatever the files say"},
    SourceFlag{"--raw-size", "raw_size", "WxH",
               "size of frames without a header, WIDTHxHEIGHT; files of any ending"},
    SourceFlag{"--raw-format", "raw_format", "FORMAT",
               "their pixels: gray16le (default), gray16be, gray8, grayf32le or grayf32be"},
    SourceFlag{"--raw-header", "raw_header_bytes", "BYTES",
               "passed over at the beginning of a raw file or stream"},
    SourceFlag{"--raw-frame-header", "raw_frame_header_bytes", "BYTES",
               "passed over in front of each raw frame"}};

// INPUT..., -o, the flags above, --simd, and those of RunOptions.
struct CommonOptions : RunOptions {
  std::vector<std::string> inputs;
  std::string output;
  // Values of the flags of sources, by their place in kSourceFlags.
  std::array<std::optional<std::string>, kSourceFlags.size()> source_flags;
  std::string simd = "auto";
  ValidityInput validity;

  void add_to(CLI::App& app);
  // --mask and --invalid, of commands that measure on frames.
  void add_validity_to(CLI::App& app);
  // `source` with the flags over it. Failures are usage errors, as below.
  [[nodiscard]] Result<io::SourceOptions> source_options(io::SourceOptions source = {}) const;
  // Checks what the parser can't.
  [[nodiscard]] Status check() const;
  // Both.
  [[nodiscard]] Result<io::SourceOptions> prepare() const;
  // What the command reads, `more` files besides inputs and mask.
  [[nodiscard]] InputFiles input_files(const io::SourceOptions& source,
                                       const std::vector<std::string>& more = {}) const;
};

// --config, --set, --dump-config.
struct ConfigOptions {
  std::string file;
  std::vector<std::string> settings;
  bool dump = false;

  void add_to(CLI::App& app);
  // The preset, which is `preset` (of --preset), else that of --set preset=NAME, else that of the
  // file; then what else the file says, then --set, each over what was before.
  [[nodiscard]] Result<DetectorOptions> detector_options(const std::optional<std::string>& preset,
                                                         io::SourceOptions& source) const;
  [[nodiscard]] Status apply(FrameDenoiserOptions& options, io::SourceOptions& source) const;
};

// --sigma auto|COUNTS: 0 stands for auto.
[[nodiscard]] Result<double> parse_sigma(const std::string& text);

// Whether the output has room for one frame or for many.
enum class Room : std::uint8_t { kMany, kOne };

// Calls `handle(frame)` for each frame of the inputs; an error (of reading or handling) is reported
// and the next frame follows, unless standard output failed or the console says that the run ends.
// SourceFrame::index is the frame's number in the run, those that cannot be read counted. Where the
// output has room for one frame and there are more, that is an error before the first one is
// handled. A signal ends the program between two frames, so `handle` keeps nothing back that would
// be missed. At the end there is the console's summary. Returns the exit code.
[[nodiscard]] int for_each_frame(const CommonOptions& common, const io::SourceOptions& source,
                                 Console& report, Room room,
                                 const std::function<Status(const io::SourceFrame&)>& handle);

// Where results of several frames go: DIR/<kind>/<stem><ending>, DIR/<stem><ending> where kind
// is empty, or a folder for each frame, DIR/<stem>/<name>. Makes the directories; stems that occur
// twice in a run get "_2", "_3" ... so that no result of the run is lost. A path that is an input
// is an error.
class OutputDirectory {
 public:
  explicit OutputDirectory(std::string directory, InputFiles inputs = {})
      : directory_(std::move(directory)), inputs_(std::move(inputs)) {}
  // Once per frame, before the paths.
  void begin_frame(const std::string& stem);
  [[nodiscard]] Result<std::string> path(const std::string& kind, const std::string& ending);
  [[nodiscard]] Result<std::string> path_in_folder(const std::string& name);

 private:
  [[nodiscard]] Result<std::string> unless_input(const std::string& path) const;

  std::string directory_;
  InputFiles inputs_;
  std::vector<std::string> used_;  // sorted
  std::string stem_;
};

// "--write a,b" split at the commas.
[[nodiscard]] std::vector<std::string> split_list(const std::string& list);

}  // namespace thermedge::cli
