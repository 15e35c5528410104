// `compare`: the classical detectors and thermedge on one sheet.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string_view>
#include <system_error>

#include "commands.hpp"
#include "detector_command.hpp"
#include "figure_output.hpp"
#include "thermedge/figures/comparison_sheet.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::cli {
namespace {

// Of --denoise: the classical detectors get the picture that thermedge denoised.
constexpr const char* kSame = "same";

struct CompareCommand : DetectorCommand {
  std::string format = "png";
  double panel_width = figures::kPanelWidth;
  std::string classical_denoiser = kSame;
  std::optional<std::string> maps;  // --write; empty: all
  ClassicalOptions classical{.log_kernel_px = 9};
  std::string canny_high = "0";
  std::string canny_low = "0";

  [[nodiscard]] int draw() const;
  [[nodiscard]] Result<figures::ComparisonOptions> comparison(
      const DetectorOptions& detector) const;
  [[nodiscard]] Result<std::vector<std::string>> wanted_maps() const;
};

// "12" or "12counts", or "3sigma".
Result<Quantity<figures::GradientUnit>> parse_gradient(const std::string& flag,
                                                       const std::string& text) {
  Quantity<figures::GradientUnit> gradient;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, gradient.value);
  const std::string_view unit(stop, static_cast<std::size_t>(end - stop));
  const bool in_sigma = unit == "sigma";
  if (error != std::errc{} || !(unit.empty() || unit == "counts" || in_sigma) ||
      !(gradient.value >= 0)) {
    return failure(ErrorCode::kInvalidArgument,
                   flag + " " + text +
                       ": should be a number of counts a pixel, or of units of the noise: 3sigma");
  }
  gradient.unit = in_sigma ? figures::GradientUnit::kSigma : figures::GradientUnit::kCounts;
  return gradient;
}

Result<figures::ComparisonOptions> CompareCommand::comparison(
    const DetectorOptions& detector) const {
  figures::ComparisonOptions options;
  options.detector = detector;
  options.classical = classical;
  if (const PaperOptions* paper = detector.paper()) {
    options.classical.canny = paper->canny;
    options.classical.canny.blur = false;  // it has a Gaussian of its own
  }
  options.panel_width = panel_width;
  for (const auto& known : kDenoiseMethods) {
    if (known.name == classical_denoiser) {
      options.classical_denoiser = known.value;
    }
  }
  const auto high = parse_gradient("--canny-high", canny_high);
  const auto low = parse_gradient("--canny-low", canny_low);
  if (!high || !low) {
    return tl::unexpected(high ? low.error() : high.error());
  }
  options.canny_thresholds = {*high, *low};
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
      "compare",
      "draw the edges of Prewitt, Roberts, Sobel, LoG, Canny and thermedge on one sheet");
  auto command = std::make_shared<CompareCommand>();
  command->add_to(app);
  command->common.add_validity_to(app);
  FigureOutput::add_options_to(app, command->format, command->panel_width);
  std::vector<std::string> denoisers = names_of(kDenoiseMethods);
  denoisers.emplace_back(kSame);
  app.add_option("--denoise", command->classical_denoiser,
                 "input of the classical detectors: same (the picture that thermedge denoised), or "
                 "the 8-bit view after none, gaussian, nlm or bm3d; --set denoise.method=... sets "
                 "thermedge's own denoiser")
      ->check(CLI::IsMember(denoisers))
      ->capture_default_str();
  app.add_option("--canny-sigma", command->classical.canny_sigma_px,
                 "Gaussian before the classical Canny, px (0: none)")
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str();
  app.add_option("--canny-high", command->canny_high,
                 "gradient above which Canny has an edge: counts a pixel, or in units of the "
                 "noise: 3sigma (0: automatic)")
      ->capture_default_str();
  app.add_option("--canny-low", command->canny_low,
                 "gradient above which Canny continues an edge, likewise (0: 0.4 of the high one)")
      ->capture_default_str();
  app.add_option("--log-kernel", command->classical.log_kernel_px,
                 "side of LoG's kernel, px (paper: 9; 0: 13, as MATLAB has it)")
      ->check(CLI::Range(0, 61))
      ->capture_default_str();
  app.add_option("--write", command->maps,
                 "write single maps too: all, or of prewitt,roberts,sobel,log,canny,thermedge");
  app.callback([command, &exit_code] { exit_code = command->draw(); });
}

}  // namespace thermedge::cli
