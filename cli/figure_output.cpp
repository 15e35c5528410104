#include "figure_output.hpp"

#include <array>
#include <filesystem>
#include <string_view>

namespace thermedge::cli {
namespace {

constexpr std::array<std::string_view, 3> kEndings = {".png", ".svg", ".pdf"};

// A file beside the sheet, "x_<name><ending>".
std::string beside_sheet(const std::string& sheet, const std::string& name,
                         const std::string& ending) {
  std::filesystem::path beside(sheet);
  beside.replace_filename(beside.stem().string() + "_" + name + ending);
  return beside.string();
}

}  // namespace

FigureOutput::FigureOutput(std::string output, std::string format, bool single, InputFiles inputs)
    : output_(std::move(output)),
      format_(std::move(format)),
      single_(single),
      directory_(output_, std::move(inputs)) {}

Result<FigureOutput> FigureOutput::create(const std::string& output, const std::string& format,
                                          const InputFiles& inputs,
                                          const std::vector<std::string>& beside) {
  if (output.empty() || output == "-") {
    return failure(ErrorCode::kInvalidArgument,
                   "-o is required: a directory, or a .png, .svg or .pdf for the sheet");
  }
  return parse_output(output, kEndings).and_then([&](const OutputTarget& target) {
    const bool single = target.kind == OutputKind::kFile;
    Status status = single ? inputs.check_file("-o", output) : inputs.check_directory("-o", output);
    for (const std::string& name : single ? beside : std::vector<std::string>()) {
      status = status.and_then(
          [&] { return inputs.check_file("-o", beside_sheet(output, name, ".png")); });
    }
    return status.map([&] { return FigureOutput(output, format, single, inputs); });
  });
}

Result<FigureOutput> FigureOutput::create_file(const std::string& output,
                                               const InputFiles& inputs) {
  const auto target = parse_output(output, kEndings);
  if (!target || target->kind != OutputKind::kFile) {
    return failure(ErrorCode::kInvalidArgument,
                   output.empty() ? "-o is required: a .png, .svg or .pdf"
                                  : "-o " + output + ": should be a file, .png, .svg or .pdf");
  }
  return create(output, target->ending.substr(1), inputs);
}

void FigureOutput::add_options_to(CLI::App& app, std::string& format, double& panel_width) {
  app.add_option("--format", format, "of the figures in -o DIR: png, svg or pdf")
      ->check(CLI::IsMember({"png", "svg", "pdf"}))
      ->capture_default_str();
  add_panel_width_to(app, panel_width);
}

void FigureOutput::add_panel_width_to(CLI::App& app, double& panel_width) {
  app.add_option("--panel-px", panel_width, "about the width of a picture on the sheet, px")
      ->check(CLI::Range(100.0, 4000.0))
      ->capture_default_str();
}

void FigureOutput::begin_frame(const std::string& stem) { directory_.begin_frame(stem); }

Status FigureOutput::write_sheet(const figures::Figure& sheet) {
  return single_ ? sheet.write(output_) : write("sheet", sheet);
}

Status FigureOutput::write(const std::string& name, const figures::Figure& figure) {
  return path(name, "." + format_).and_then([&](const std::string& file) {
    return figure.write(file);
  });
}

Result<std::string> FigureOutput::path(const std::string& name, const std::string& ending) {
  return single_ ? beside_sheet(output_, name, ending) : directory_.path_in_folder(name + ending);
}

}  // namespace thermedge::cli
