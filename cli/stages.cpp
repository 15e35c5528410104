// `stages`: what every step makes of a frame, as pictures.
#include <fmt/core.h>

#include <memory>

#include "commands.hpp"
#include "detector_command.hpp"
#include "thermedge/figures/stages_sheet.hpp"

namespace thermedge::cli {
namespace {

struct StagesCommand : DetectorCommand {
  std::string format = "png";

  [[nodiscard]] int run_sheets() const;
};

// The sheet alone, or the sheet and its panels in DIR/<stem>/.
class StagesOutput {
 public:
  StagesOutput(std::string output, std::string format)
      : one_file_(figures::is_figure_path(output)),
        output_(std::move(output)),
        format_(std::move(format)),
        directory_(output_) {}

  Status write(const figures::StagesFigures& made, const std::string& stem) {
    if (one_file_) {
      return ++written_ == 1 ? made.sheet.write(output_) : only_one_frame(output_);
    }
    directory_.begin_frame(stem);
    Status status = write_into_directory("sheet", made.sheet);
    for (const figures::NamedFigure& step : made.steps) {
      status = status.and_then([&] { return write_into_directory(step.name, step.figure); });
    }
    return status;
  }

 private:
  Status write_into_directory(const std::string& name, const figures::Figure& figure) {
    return directory_.path_in_folder(name + "." + format_).and_then([&](const std::string& path) {
      return figure.write(path);
    });
  }

  bool one_file_;
  std::string output_;
  std::string format_;
  OutputDirectory directory_;
  int written_ = 0;
};

int StagesCommand::run_sheets() const {
  return run([&](const DetectorOptions& options, const io::SourceOptions& source, Report& report) {
    if (common.output.empty()) {
      return report.fail({ErrorCode::kInvalidArgument,
                          "-o is required: a directory, or a .png, .svg or .pdf for the sheet"});
    }
    auto sheet = figures::StagesSheet::create(options);
    if (!sheet) {
      return report.fail(sheet.error());
    }
    StagesOutput output(common.output, format);
    return for_each_frame(common, source, report, [&](const io::Frame& frame) -> Status {
      return sheet->draw(frame.counts, frame.bits, frame.source)
          .and_then(
              [&](const figures::StagesFigures& made) { return output.write(made, frame.stem); });
    });
  });
}

}  // namespace

void add_stages(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "stages", "every step from the frame to its edges as pictures, and all on one sheet");
  auto command = std::make_shared<StagesCommand>();
  command->add_to(app);
  command->add_denoising_to(app);
  app.add_option("--format", command->format, "of the pictures in -o DIR: png, svg or pdf")
      ->check(CLI::IsMember({"png", "svg", "pdf"}))
      ->capture_default_str();
  app.callback([command, &exit_code] { exit_code = command->run_sheets(); });
}

}  // namespace thermedge::cli
