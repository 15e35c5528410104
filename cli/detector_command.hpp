// The options of the detector on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <optional>
#include <string>

#include "common.hpp"
#include "thermedge/options.hpp"

namespace thermedge::cli {

// Flags for options that are used often: the last word of the option's name, or an alias.
struct OptionFlag {
  const char* flag;
  const char* option;
  const char* help;
  bool of_denoising;
};
inline constexpr std::array kFlags = {
    OptionFlag{"--keep", "selection.keep_edges", "keep the best N edges (ET; 0: all)", false},
    OptionFlag{"--max-edgels", "selection.max_edgels",
               "most edgels in the kept edges (0: any number)", false},
    OptionFlag{"--max-false-alarms", "selection.max_false_alarms",
               "false edges accepted in a frame of noise, on average (0: no test)", false},
    OptionFlag{"--min-contrast", "selection.min_contrast",
               "smallest contrast of an edge: counts, or with a unit, 3sigma or 0.5degC", false},
    OptionFlag{"--degc-per-count", "selection.degc_per_count",
               "worth of a count, degC, for --min-contrast in degC", false},
    OptionFlag{"--denoise", "denoise.method", "denoiser: none, gaussian, nlm or bm3d", true}};

// The options of a command that runs the detector on frames: the common ones and --preset,
// --config, --set, --dump-config, --camera, and those of kFlags; --denoise and --sigma where a
// frame is denoised.
struct DetectorCommand {
  CommonOptions common;
  ConfigOptions config;
  std::optional<std::string> preset;
  // Values of the flags that stand for one option each, by their place in kFlags.
  std::array<std::optional<std::string>, kFlags.size()> flags;
  std::optional<std::string> sigma;
  std::optional<std::string> camera;  // instead of --degc-per-count

  void add_to(CLI::App& app);
  void add_denoising_to(CLI::App& app);
  // The preset, then the file, then --set, then dedicated options, each over what was before.
  // `source` takes what the file and --set say about sources.
  [[nodiscard]] Result<DetectorOptions> options(io::SourceOptions& source) const;

  // Prints the options where --dump-config asks for it; else runs `work`. Says what is wrong with
  // the arguments. Returns the exit code.
  using Work = std::function<int(const DetectorOptions&, const io::SourceOptions&, Console&)>;
  [[nodiscard]] int run(const Work& work) const;
};

}  // namespace thermedge::cli
