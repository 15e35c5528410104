// `compare`: the classical detectors and thermedge on one sheet.
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "detector_command.hpp"
#include "figure_output.hpp"
#include "thermedge/figures/comparison_sheet.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::cli {
namespace {

struct CompareCommand : DetectorCommand {
  std::string format = "png";
  double panel_width = figures::kPanelWidth;
  std::string classical_denoiser = "none";
  std::optional<std::string> maps;  // --write
  ClassicalOptions classical;

  [[nodiscard]] int draw() const;
  [[nodiscard]] Result<figures::ComparisonOptions> comparison(
      const DetectorOptions& detector) const;
  [[nodiscard]] Result<std::vector<std::string>> wanted_maps() const;
};

Result<figures::ComparisonOptions> CompareCommand::comparison(
    const DetectorOptions& detector) const {
  figures::ComparisonOptions options;
  options.detector = detector;
  options.classical = classical;
  if (const PaperOptions* paper = detector.paper()) {
    options.classical.canny = paper->canny;
  }
  options.panel_width = panel_width;
  for (const auto& known : kDenoiseMethods) {
    if (known.name == classical_denoiser) {
      options.classical_denoiser = known.value;
    }
  }
  return options;
}

// The names of the maps to be written, of none without --write.
Result<std::vector<std::string>> CompareCommand::wanted_maps() const {
  std::vector<std::string> known = {"thermedge"};
  for (const ClassicalName& method : kClassicalMethods) {
    known.emplace_back(method.name);
  }
  if (!maps) {
    return std::vector<std::string>{};
  }
  if (*maps == "all") {
    return known;
  }
  std::vector<std::string> wanted = split_list(*maps);
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      return failure(
          ErrorCode::kInvalidArgument,
          fmt::format("--write {}: should be all, or of prewitt, roberts, sobel, log, canny, "
                      "thermedge",
                      name));
    }
  }
  return wanted;
}

Status write(const figures::Comparison& made, const std::vector<std::string>& wanted,
             FigureOutput& output) {
  Status status = output.write_sheet(made.sheet);
  for (const figures::ComparedMap& map : made.maps) {
    if (std::find(wanted.begin(), wanted.end(), map.name) != wanted.end()) {
      status = status.and_then([&] { return output.path(map.name, ".png"); })
                   .and_then([&](const std::string& path) {
                     return io::write_picture(path, map.edges.view());
                   });
    }
  }
  return status;
}

int CompareCommand::draw() const {
  return run(
      [&](const DetectorOptions& detector, const io::SourceOptions& source, Console& report) {
        const auto wanted = wanted_maps();
        if (!wanted) {
          return report.fail(wanted.error());
        }
        auto output = FigureOutput::create(common.output, format,
                                           common.input_files(source, {config.file}), *wanted);
        if (!output) {
          return report.fail(output.error());
        }
        report.set_results(common.output);
        auto sheet = comparison(detector).and_then(figures::ComparisonSheet::create);
        if (!sheet) {
          return report.fail(sheet.error());
        }
        return for_each_frame(
            common, source, report, output->room(), [&](const io::SourceFrame& frame) {
              output->begin_frame(frame.stem);
              return sheet->draw(frame.counts, frame.bits, frame.source, frame.valid)
                  .and_then([&](const figures::Comparison& made) {
                    return write(made, *wanted, *output);
                  });
            });
      });
}

}  // namespace

void add_compare(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "compare", "Prewitt, Roberts, Sobel, LoG, Canny and thermedge on one sheet");
  auto command = std::make_shared<CompareCommand>();
  command->add_to(app);
  command->common.add_validity_to(app);
  FigureOutput::add_options_to(app, command->format, command->panel_width);
  app.add_option("--denoise", command->classical_denoiser,
                 "denoiser in front of the classical detectors (thermedge's own: --set "
                 "denoise.method=...)")
      ->check(CLI::IsMember(names_of(kDenoiseMethods)))
      ->capture_default_str();
  app.add_option("--log-kernel", command->classical.log_kernel_px,
                 "side of LoG's kernel, px (0: 13; paper: 9)")
      ->check(CLI::Range(0, 61))
      ->capture_default_str();
  app.add_option("--write", command->maps,
                 "write single maps too: all, or of prewitt,roberts,sobel,log,canny,thermedge");
  app.callback([command, &exit_code] { exit_code = command->draw(); });
}

}  // namespace thermedge::cli
