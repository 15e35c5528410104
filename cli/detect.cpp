#include <fmt/core.h>

#include <memory>

#include "commands.hpp"
#include "common.hpp"
#include "result_writer.hpp"
#include "thermedge/io/config.hpp"

namespace thermedge::cli {
namespace {

// What `detect` and `trace` share, and what only `detect` has.
struct EdgeCommand {
  CommonOptions common;
  ConfigOptions config;
  std::string preset = "paper";
  std::string write;
  std::optional<int> keep;
  std::optional<int> max_edgels;
  std::optional<std::string> denoise;
  std::optional<std::string> sigma;

  void add_to(CLI::App& app);
  void add_denoising(CLI::App& app);
  [[nodiscard]] Result<DetectorOptions> detector_options() const;
};

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  names.reserve(kPresets.size());
  for (const auto& known : kPresets) {
    names.emplace_back(known.name);
  }
  return names;
}

void EdgeCommand::add_to(CLI::App& app) {
  common.add_to(app);
  config.add_to(app);
  app.get_option("INPUT")->required(false);  // --dump-config needs none
  app.add_option("--preset", preset, "named set of defaults")
      ->check(CLI::IsMember(preset_names()))
      ->capture_default_str();
  app.add_option("--keep", keep, "keep the best so many edges (ET; 0: all)")
      ->check(CLI::Range(0, 1000000000));
  app.add_option("--max-edgels", max_edgels, "most edgels in the kept edges (0: any number)")
      ->check(CLI::Range(0, 1000000000));
  app.add_option("--write", write,
                 "for -o DIR: mask,strength,labels,json,svg,overlay,distance (default mask)");
}

void EdgeCommand::add_denoising(CLI::App& app) {
  app.add_option("--denoise", denoise, "denoiser")
      ->check(CLI::IsMember({"none", "gaussian", "nlm", "bm3d"}));
  app.add_option("--sigma", sigma, "noise told to the denoiser: auto or counts");
}

// Dedicated options come last, over --set, over the file, over the preset.
Result<DetectorOptions> EdgeCommand::detector_options() const {
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
  options.scoring.keep_edges = keep.value_or(options.scoring.keep_edges);
  options.scoring.max_edgels = max_edgels.value_or(options.scoring.max_edgels);
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

int fail(Report& report, const Error& error) {
  report.error(error.message);
  return error.code == ErrorCode::kInvalidArgument ? kBadUsage : kBadInput;
}

// Prepares everything, then runs `step(detector, frame)` on each frame and writes the result.
template <class Step>
int run(const EdgeCommand& command, Step&& step) {
  Report report = command.common.report();
  const auto options = command.detector_options();
  if (!options) {
    return fail(report, options.error());
  }
  if (command.config.dump) {
    fmt::print("{}", io::dump_config(*options));
    return kGood;
  }
  if (command.common.inputs.empty()) {
    return fail(report, {ErrorCode::kInvalidArgument,
                         "INPUT is required: a file, directory, "
                         "glob, - or sim:NAME"});
  }
  const auto source = command.common.prepare();
  if (!source) {
    return fail(report, source.error());
  }
  auto writer = ResultWriter::create(command.common.output, command.write);
  if (!writer) {
    return fail(report, writer.error());
  }
  auto detector = Detector::create(*options);
  if (!detector) {
    return fail(report, detector.error());
  }
  return for_each_frame(command.common, *source, report, [&](const io::Frame& frame) -> Status {
    return step(*detector, frame).and_then([&](const Detection* detection) {
      return writer->write(*detection, {frame.source, std::string(preset_name(options->preset))},
                           frame.stem);
    });
  });
}

}  // namespace

void add_detect(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand("detect", "find edges in frames");
  auto command = std::make_shared<EdgeCommand>();
  command->add_to(app);
  command->add_denoising(app);
  app.callback([command, &exit_code] {
    exit_code = run(*command, [](Detector& detector, const io::Frame& frame) {
      return detector.detect(frame.counts, frame.bits);
    });
  });
}

void add_trace(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "trace", "contours, corners, links and ranks of somebody else's binary edge maps");
  auto command = std::make_shared<EdgeCommand>();
  command->add_to(app);
  app.callback([command, &exit_code] {
    exit_code = run(*command, [map = Image<std::uint8_t>()](Detector& detector,
                                                            const io::Frame& frame) mutable {
      map.resize(frame.counts.width(), frame.counts.height());
      for (int y = 0; y < map.height(); ++y) {
        std::transform(frame.counts.row(y), frame.counts.row(y) + map.width(), map.row(y),
                       [](std::uint16_t value) { return std::uint8_t{value != 0}; });
      }
      return detector.trace(map);
    });
  });
}

}  // namespace thermedge::cli
