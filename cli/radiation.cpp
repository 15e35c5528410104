// `radiation`: Planck's curves and Wien's maxima.
#include <memory>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "figure_output.hpp"
#include "thermedge/figures/radiation_sheet.hpp"

namespace thermedge::cli {
namespace {

struct RadiationCommand {
  std::string output;
  std::vector<double> temperatures_k = {250, 275, 300, 325, 350};
  Band band;
  double panel_width = figures::kPanelWidth;

  [[nodiscard]] int draw() const;
};

int RadiationCommand::draw() const {
  Console report(false, false);
  auto target = FigureOutput::create_file(output, {});
  if (!target) {
    return report.fail(target.error());
  }
  const auto figure = figures::draw_radiation(temperatures_k, band, panel_width);
  if (!figure) {
    return report.fail(figure.error());
  }
  const Status status = target->write_sheet(*figure);
  return status ? kGood : report.fail(status.error());
}

}  // namespace

void add_radiation(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "radiation", "Planck's curves of thermal radiation with Wien's maxima, as a picture");
  auto command = std::make_shared<RadiationCommand>();
  app.add_option("-o,--output", command->output, "picture: .png, .svg or .pdf")->required();
  app.add_option("--kelvin", command->temperatures_k, "temperatures of the bodies, K: 280,300")
      ->delimiter(',')
      ->expected(1, 8)
      ->capture_default_str();
  app.add_option("--band-from", command->band.low_um, "lower end of the camera's band, um")
      ->capture_default_str();
  app.add_option("--band-to", command->band.high_um, "upper end of the camera's band, um")
      ->capture_default_str();
  FigureOutput::add_panel_width_to(app, command->panel_width);
  app.callback([command, &exit_code] { exit_code = command->draw(); });
}

}  // namespace thermedge::cli
