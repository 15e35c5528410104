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
  // Fails where -o is missing, has an ending that is not written, or is an input or its folder.
  // `beside`: names of what is written beside a single sheet as PNG.
  [[nodiscard]] static Result<FigureOutput> create(const std::string& output,
                                                   const std::string& format,
                                                   const InputFiles& inputs,
                                                   const std::vector<std::string>& beside = {});

  // The same for a sheet that is always one file.
  [[nodiscard]] static Result<FigureOutput> create_file(const std::string& output,
                                                        const InputFiles& inputs);

  // Once per frame, before the others.
  void begin_frame(const std::string& stem);
  [[nodiscard]] Room room() const { return single_ ? Room::kOne : Room::kMany; }
  [[nodiscard]] bool is_single_file() const { return single_; }
  [[nodiscard]] Status write_sheet(const figures::Figure& sheet);
  [[nodiscard]] Status write(const std::string& name, const figures::Figure& figure);
  [[nodiscard]] Result<std::string> path(const std::string& name, const std::string& ending);

  // --format and --panel-px.
  static void add_options_to(CLI::App& app, std::string& format, double& panel_width);
  static void add_panel_width_to(CLI::App& app, double& panel_width);

 private:
  FigureOutput(std::string output, std::string format, bool single, InputFiles inputs);

  std::string output_;
  std::string format_;
  bool single_;
  OutputDirectory directory_;
};

}  // namespace thermedge::cli
