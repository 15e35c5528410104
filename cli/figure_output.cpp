#include "figure_output.hpp"

#include <filesystem>

namespace thermedge::cli {

FigureOutput::FigureOutput(std::string output, std::string format)
    : output_(std::move(output)),
      format_(std::move(format)),
      single_(figures::is_figure_path(output_)),
      directory_(output_) {}

Result<FigureOutput> FigureOutput::create(const CommonOptions& common, const std::string& format) {
  if (common.output.empty()) {
    return failure(ErrorCode::kInvalidArgument,
                   "-o is required: a directory, or a .png, .svg or .pdf for the sheet");
  }
  return FigureOutput(common.output, format);
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

Status FigureOutput::begin_frame(const std::string& stem) {
  directory_.begin_frame(stem);
  if (++frames_ > 1 && single_) {
    return only_one_frame(output_);
  }
  return {};
}

Status FigureOutput::write_sheet(const figures::Figure& sheet) {
  return single_ ? sheet.write(output_) : write("sheet", sheet);
}

Status FigureOutput::write(const std::string& name, const figures::Figure& figure) {
  return path(name, "." + format_).and_then([&](const std::string& file) {
    return figure.write(file);
  });
}

Result<std::string> FigureOutput::path(const std::string& name, const std::string& ending) {
  if (!single_) {
    return directory_.path_in_folder(name + ending);
  }
  std::filesystem::path beside(output_);
  beside.replace_filename(beside.stem().string() + "_" + name + ending);
  return beside.string();
}

}  // namespace thermedge::cli
