// Where `stages` and `compare` put their pictures.
#pragma once

#include <string>

#include "common.hpp"
#include "thermedge/figures/figure.hpp"

namespace thermedge::cli {

// -o x.png (.svg, .pdf): the sheet of the one frame, and what else is written beside it as
// x_<name>.<ending>. -o DIR: DIR/<stem>/sheet.<format> and DIR/<stem>/<name>.<ending>.
class FigureOutput {
 public:
  // Fails where -o is missing.
  [[nodiscard]] static Result<FigureOutput> create(const CommonOptions& common,
                                                   const std::string& format);

  // Once per frame, before the others; fails for a second frame of a single sheet.
  [[nodiscard]] Status begin_frame(const std::string& stem);
  [[nodiscard]] bool is_single_file() const { return single_; }
  [[nodiscard]] Status write_sheet(const figures::Figure& sheet);
  [[nodiscard]] Status write(const std::string& name, const figures::Figure& figure);
  [[nodiscard]] Result<std::string> path(const std::string& name, const std::string& ending);

  // --format and --panel-px.
  static void add_options_to(CLI::App& app, std::string& format, double& panel_width);
  static void add_panel_width_to(CLI::App& app, double& panel_width);

 private:
  FigureOutput(std::string output, std::string format);

  std::string output_;
  std::string format_;
  bool single_;
  OutputDirectory directory_;
  int frames_ = 0;
};

}  // namespace thermedge::cli
