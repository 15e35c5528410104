// `stages`: what every step makes of a frame, as pictures.
#include <memory>

#include "commands.hpp"
#include "detector_command.hpp"
#include "figure_output.hpp"
#include "thermedge/figures/stages_sheet.hpp"

namespace thermedge::cli {
namespace {

struct StagesCommand : DetectorCommand {
  std::string format = "png";
  double panel_width = figures::kPanelWidth;

  [[nodiscard]] int draw() const;
};

// A single sheet goes without the pictures of the steps.
Status write(const figures::StagesFigures& made, FigureOutput& output) {
  Status status = output.write_sheet(made.sheet);
  if (!output.is_single_file()) {
    for (const figures::NamedFigure& step : made.steps) {
      status = status.and_then([&] { return output.write(step.name, step.figure); });
    }
  }
  return status;
}

int StagesCommand::draw() const {
  return run([&](const DetectorOptions& options, const io::SourceOptions& source, Console& report) {
    auto output =
        FigureOutput::create(common.output, format, common.input_files(source, {config.file}));
    if (!output) {
      return report.fail(output.error());
    }
    report.set_results(common.output);
    auto sheet = figures::StagesSheet::create(options, panel_width);
    if (!sheet) {
      return report.fail(sheet.error());
    }
    return for_each_frame(
        common, source, report, output->room(), [&](const io::SourceFrame& frame) {
          output->begin_frame(frame.stem);
          return sheet->draw(frame.counts, frame.bits, frame.source, frame.valid)
              .and_then([&](const figures::StagesFigures& made) { return write(made, *output); });
        });
  });
}

}  // namespace

void add_stages(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "stages", "draw every step from the frame to its edges, as pictures and on one sheet");
  auto command = std::make_shared<StagesCommand>();
  command->add_to(app);
  command->add_denoising_to(app);
  command->common.add_validity_to(app);
  FigureOutput::add_options_to(app, command->format, command->panel_width);
  app.callback([command, &exit_code] { exit_code = command->draw(); });
}

}  // namespace thermedge::cli
