#include "detector_command.hpp"

#include <fmt/core.h>

#include <vector>

#include "thermedge/io/config.hpp"

namespace thermedge::cli {
namespace {}  // namespace

void DetectorCommand::add_to(CLI::App& app) {
  common.add_to(app);
  config.add_to(app);
  app.get_option("INPUT")->required(false);  // --dump-config needs none
  app.add_option("--preset", preset, "named set of defaults")
      ->check(CLI::IsMember(names_of(kPresets)))
      ->capture_default_str();
  app.add_option("--keep", keep, "keep the best so many edges (ET; 0: all)")
      ->check(CLI::Range(0, 1000000000));
  app.add_option("--max-edgels", max_edgels, "most edgels in the kept edges (0: any number)")
      ->check(CLI::Range(0, 1000000000));
  app.add_option("--max-false-alarms", max_false_alarms,
                 "false edges in a frame of noise that are put up with, on average (0: no test)")
      ->check(CLI::Range(0.0, 1e9));
}

void DetectorCommand::add_denoising_to(CLI::App& app) {
  app.add_option("--denoise", denoise, "denoiser")->check(CLI::IsMember(names_of(kDenoiseMethods)));
  app.add_option("--sigma", sigma, "noise told to the denoiser: auto or counts");
}

Result<DetectorOptions> DetectorCommand::options() const {
  DetectorOptions options;
  for (const auto& known : kPresets) {
    if (known.name == preset) {
      options = preset_options(known.value);
    }
  }
  if (Status status = config.apply(options); !status) {
    return tl::unexpected(status.error());
  }
  if (common.threads != 0) {
    options.threads = common.threads;
  }
  options.selection.keep_edges = keep.value_or(options.selection.keep_edges);
  options.selection.max_edgels = max_edgels.value_or(options.selection.max_edgels);
  options.selection.max_false_alarms =
      max_false_alarms.value_or(options.selection.max_false_alarms);
  if (denoise) {
    if (Status status = io::apply_setting("denoise.method=" + *denoise, options); !status) {
      return tl::unexpected(status.error());
    }
  }
  if (sigma) {
    const Result<double> counts = parse_sigma(*sigma);
    if (!counts) {
      return tl::unexpected(counts.error());
    }
    options.denoise.sigma_counts = *counts;
  }
  return options;
}

int DetectorCommand::run(const Work& work) const {
  Console report = common.report();
  const auto chosen = options();
  if (!chosen) {
    return report.fail(chosen.error());
  }
  if (config.dump) {
    fmt::print("{}", io::dump_config(*chosen));
    return kGood;
  }
  if (common.inputs.empty()) {
    return report.fail(
        {ErrorCode::kInvalidArgument, "INPUT is required: a file, directory, glob, - or sim:NAME"});
  }
  const auto source = common.prepare();
  if (!source) {
    return report.fail(source.error());
  }
  return work(*chosen, *source, report);
}

}  // namespace thermedge::cli
