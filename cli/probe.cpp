// `probe`: what a recording is like.
#include "thermedge/probe/probe.hpp"

#include <fmt/core.h>

#include <memory>
#include <optional>

#include "commands.hpp"
#include "common.hpp"
#include "figure_output.hpp"
#include "probe_page.hpp"
#include "standard_output.hpp"
#include "thermedge/figures/probe_sheet.hpp"
#include "thermedge/io/probe_file.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/options.hpp"
#include "thermedge/radiometry/planck.hpp"

namespace thermedge::cli {
namespace {

struct ProbeCommand {
  CommonOptions common;
  std::optional<double> degc_per_count;
  std::string camera;
  std::string preset{preset_name(Preset::kRobust)};
  std::string toml;
  double panel_width = figures::kPanelWidth;
  bool json = false;

  [[nodiscard]] int run() const;

 private:
  [[nodiscard]] Result<ProbeOptions> options() const;
  [[nodiscard]] Status write_files(const RecordingReport& result,
                                   ImageView<const std::uint16_t> first_frame) const;
  [[nodiscard]] std::string name() const;
};

// "swapped" is the other one of what a file says; where an order was given, it is the wrong one.
void set_other_byte_order(io::SampleOrder given, RecordingReport& report) {
  for (InputFault& fault : report.input) {
    if (fault.option == "source.byte_order" && given != io::SampleOrder::kAsFormat) {
      fault.value = given == io::SampleOrder::kLittle ? "big"
                    : given == io::SampleOrder::kBig  ? "little"
                                                      : "format";
    }
  }
}

int ProbeCommand::run() const {
  Console report = common.report();
  const auto source = common.prepare();
  if (!source) {
    return report.fail(source.error());
  }
  auto options = this->options();
  if (!options) {
    return report.fail(options.error());
  }
  if (!common.output.empty() && !figures::is_figure_path(common.output)) {
    return report.fail(
        {ErrorCode::kInvalidArgument,
         fmt::format("-o {}: the name should end in .png, .svg or .pdf", common.output)});
  }
  const InputFiles inputs = common.input_files(*source);
  if (const Status status = inputs.check_file("-o", common.output).and_then([&] {
        return inputs.check_file("--toml", toml);
      });
      !status) {
    return report.fail(status.error());
  }
  std::optional<RecordingProbe> recording;
  Image<std::uint16_t> first_frame;
  const int exit_code = for_each_frame(
      common, *source, report, Room::kMany, [&](const io::SourceFrame& frame) -> Status {
        if (!recording) {
          first_frame = frame.counts.clone();
          if (frame.counts_model && !options->camera && !options->degc_per_count) {
            options->camera = frame.counts_model;
            options->camera_source = CameraSource::kNumbers;
          }
          recording.emplace(*options);
        }
        return recording->add(frame.counts, frame.bits, frame.valid,
                              frame.is_float() ? frame.scale.counts_per_unit : 0);
      });
  RecordingReport result = recording ? recording->report() : RecordingReport();
  set_other_byte_order(source->byte_order, result);
  if (result.frames == 0) {
    if (exit_code == kGood) {
      report.error(name() + ": holds no frames");
    }
    return kBadInput;
  }
  if (const Status status = write_files(result, first_frame.view()); !status) {
    return report.fail(status.error());
  }
  print(json ? io::probe_to_json(result, common.inputs) : probe_page(result, name()));
  return exit_code;
}

// As the detector with this preset takes the frames.
Result<ProbeOptions> ProbeCommand::options() const {
  ProbeOptions options;
  options.preset = preset_named(preset).value_or(options.preset);
  const DetectorOptions detector(options.preset);
  options.validity = detector.validity;
  options.bad_pixels = detector.bad_pixels;
  options.degc_per_count = degc_per_count;
  if (!camera.empty()) {
    const auto model = parse_counts_model(camera);
    if (!model) {
      return failure(model.error().code, "--camera: " + model.error().message);
    }
    options.camera = *model;
    const bool has_numbers = camera.find(':') != std::string::npos;
    options.camera_source = has_numbers ? CameraSource::kNumbers : CameraSource::kName;
  }
  return options;
}

Status ProbeCommand::write_files(const RecordingReport& result,
                                 ImageView<const std::uint16_t> first_frame) const {
  Status status;
  if (!toml.empty()) {
    status = io::write_file(toml, io::suggested_toml(result));
  }
  if (!common.output.empty()) {
    status = status.and_then([&] {
      return figures::draw_probe(result, first_frame, name(), panel_width).write(common.output);
    });
  }
  return status;
}

std::string ProbeCommand::name() const {
  return common.inputs.size() == 1
             ? common.inputs.front()
             : fmt::format("{} and {} more", common.inputs.front(), common.inputs.size() - 1);
}

}  // namespace

void add_probe(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "probe", "what a recording is like: range, noise, stripes, bad pixels, freezes, options");
  auto command = std::make_shared<ProbeCommand>();
  command->common.add_to(app);
  command->common.add_validity_to(app);
  app.get_option("-o")->description("also as a picture: .png, .svg or .pdf");
  CLI::Option* worth = app.add_option("--degc-per-count", command->degc_per_count,
                                      "worth of a count, degC (0.01 is assumed without it)")
                           ->check(CLI::Range(1e-9, 1000.0));
  app.add_option("--camera", command->camera,
                 "how counts become degC, where the file does not tell: linear, optris, lepton, "
                 "lepton-0.1, "
                 "linear:DEGC_PER_COUNT,DEGC_AT_ZERO or planck:R1,B,F,O,R2")
      ->excludes(worth);
  FigureOutput::add_panel_width_to(app, command->panel_width);
  app.add_option("--preset", command->preset, "preset whose options are suggested")
      ->check(CLI::IsMember(names_of(kPresets)))
      ->capture_default_str();
  app.add_flag("--json", command->json, "everything as one JSON object");
  app.add_option("--toml", command->toml, "file for the suggested options, for detect --config");
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

}  // namespace thermedge::cli
