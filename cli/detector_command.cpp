#include "detector_command.hpp"

#include <fmt/format.h>

#include <vector>

#include "standard_output.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/io/source_options.hpp"
#include "thermedge/radiometry/planck.hpp"

namespace thermedge::cli {
namespace {

// The kind of value of an option for help and completion: "NAME:{none,gaussian}" where it is one of
// a list.
std::string type_of(std::string_view option) {
  for (const io::OptionInfo& known : io::list_options()) {
    if (known.name == option && !known.choices.empty()) {
      return fmt::format("NAME:{{{}}}", fmt::join(known.choices, ","));
    }
  }
  return "VALUE";
}

void add_flags(bool of_denoising, DetectorCommand& command, CLI::App& app) {
  for (std::size_t i = 0; i < kFlags.size(); ++i) {
    if (kFlags[i].of_denoising == of_denoising) {
      app.add_option(kFlags[i].flag, command.flags[i], kFlags[i].help)
          ->type_name(type_of(kFlags[i].option));
    }
  }
}

// Worth of a count of a camera, degC.
Result<double> parse_camera(const std::string& text) {
  const auto model = parse_counts_model(text);
  if (!model) {
    return failure(model.error().code, "--camera: " + model.error().message);
  }
  if (!model->is_linear()) {
    return failure(ErrorCode::kInvalidArgument,
                   "--camera " + text +
                       ": its counts are not in proportion to degC; give --degc-per-count for the "
                       "temperatures that matter");
  }
  return model->degc_per_count(0);
}

}  // namespace

void DetectorCommand::add_to(CLI::App& app) {
  common.add_to(app);
  config.add_to(app);
  app.get_option("INPUT")->required(false);  // --dump-config needs none
  app.add_option("--preset", preset, "named set of defaults: robust, fast or paper")
      ->check(CLI::IsMember(names_of(kPresets)));
  add_flags(false, *this, app);
  app.add_option("--camera", camera,
                 "for --min-contrast in degC, instead of --degc-per-count: linear, optris, lepton, "
                 "lepton-0.1 or linear:DEGC_PER_COUNT,DEGC_AT_ZERO")
      ->excludes("--degc-per-count");
}

void DetectorCommand::add_denoising_to(CLI::App& app) {
  add_flags(true, *this, app);
  app.add_option("--sigma", sigma, "noise told to the denoiser: auto or counts");
}

Result<DetectorOptions> DetectorCommand::options(io::SourceOptions& source) const {
  auto configured = config.detector_options(preset, source);
  if (!configured) {
    return configured;
  }
  DetectorOptions& options = *configured;
  Status status;
  for (std::size_t i = 0; i < kFlags.size() && status; ++i) {
    if (flags[i]) {
      status = io::apply_setting(std::string(kFlags[i].option) + "=" + *flags[i], options)
                   .map_error([&](Error error) {
                     error.message = std::string(kFlags[i].flag) + ": " + error.message;
                     return error;
                   });
    }
  }
  if (camera && status) {
    status =
        parse_camera(*camera).map([&](double degc) { options.selection.degc_per_count = degc; });
  }
  if (sigma && status) {
    status = parse_sigma(*sigma).map([&](double counts) { options.denoise.sigma_counts = counts; });
  }
  options.threads = common.threads.value_or(options.threads);
  options.simd = common.simd;
  status = status.and_then([&] { return options.check(); });
  return status.map([&] { return options; });
}

int DetectorCommand::run(const Work& work) const {
  Console report = common.report();
  io::SourceOptions configured;
  const auto chosen = options(configured);
  if (!chosen) {
    return report.fail(chosen.error());
  }
  const auto source = common.source_options(configured);
  if (!source) {
    return report.fail(source.error());
  }
  if (config.dump) {
    print(io::dump_config(*chosen) + io::dump_source_options(*source));
    return kGood;
  }
  if (const Status status = common.check(); !status) {
    return report.fail(status.error());
  }
  return work(*chosen, *source, report);
}

}  // namespace thermedge::cli
