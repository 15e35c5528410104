// `evaluate --tracks`: do edges keep their identities?
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "console.hpp"
#include "thermedge/eval/tracks.hpp"

namespace thermedge::cli {

struct TracksCommand {
  bool on = false;
  eval::TracksOptions options;

  // The flag and the options that only it has.
  void add_to(CLI::App& app);
  // The page or the JSON. A weakest contrast below 0 was not given.
  [[nodiscard]] Result<std::string> run(const std::string& found, const std::string& truth,
                                        double least_contrast_counts, double sigma_counts,
                                        int threads, bool json, Console& report) const;
};

}  // namespace thermedge::cli
