// The options of the detector on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "common.hpp"
#include "thermedge/options.hpp"

namespace thermedge::cli {

// The options of a command that runs the detector on frames: the common ones and --preset,
// --config, --set, --dump-config, --keep, --max-edgels, --max-false-alarms; --denoise and --sigma
// where a frame is denoised.
struct DetectorCommand {
  CommonOptions common;
  ConfigOptions config;
  std::string preset{preset_name(DetectorOptions{}.preset)};
  std::optional<int> keep;
  std::optional<int> max_edgels;
  std::optional<double> max_false_alarms;
  std::optional<std::string> denoise;
  std::optional<std::string> sigma;

  void add_to(CLI::App& app);
  void add_denoising_to(CLI::App& app);
  // Dedicated options come last, over --set, over the file, over the preset.
  [[nodiscard]] Result<DetectorOptions> options() const;

  // Prints the options where --dump-config asks for it; else runs `work`. Says what is wrong with
  // the arguments. Returns the exit code.
  using Work = std::function<int(const DetectorOptions&, const io::SourceOptions&, Console&)>;
  [[nodiscard]] int run(const Work& work) const;
};

}  // namespace thermedge::cli
