// `snr`: frames of high and low signal-to-noise ratio side by side.
#include <memory>
#include <vector>

#include "commands.hpp"
#include "common.hpp"
#include "figure_output.hpp"
#include "thermedge/figures/snr_sheet.hpp"

namespace thermedge::cli {
namespace {

struct SnrCommand {
  CommonOptions common;
  GreyScaleOptions grey_scale;
  double degc_per_count = kDegcPerCount;
  double panel_width = figures::kPanelWidth;

  [[nodiscard]] int draw() const;

 private:
  [[nodiscard]] Result<figures::Figure> sheet_of(const std::vector<Image<std::uint16_t>>& counts,
                                                 const std::vector<std::string>& sources) const;
};

Result<figures::Figure> SnrCommand::sheet_of(const std::vector<Image<std::uint16_t>>& counts,
                                             const std::vector<std::string>& sources) const {
  std::vector<figures::SnrFrame> frames;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    frames.push_back({counts[i].view(), sources[i]});
  }
  return figures::draw_snr(frames, grey_scale, degc_per_count, panel_width);
}

int SnrCommand::draw() const {
  Console report = common.report();
  const auto source = common.prepare();
  if (!source) {
    return report.fail(source.error());
  }
  auto target = FigureOutput::create_file(common.output, common.input_files(*source));
  if (!target) {
    return report.fail(target.error());
  }
  std::vector<Image<std::uint16_t>> counts;
  std::vector<std::string> sources;
  const int code = for_each_frame(
      common, *source, report, Room::kMany, [&](const io::SourceFrame& frame) -> Status {
        if (counts.size() == figures::kMostSnrFrames) {
          return failure(ErrorCode::kInvalidArgument,
                         frame.source + ": the sheet has room for 6 frames; left out");
        }
        counts.push_back(frame.counts.clone());
        sources.push_back(frame.stem);
        return {};
      });
  if (counts.empty()) {
    return code;
  }
  const auto sheet = sheet_of(counts, sources);
  if (!sheet) {
    return report.fail(sheet.error());
  }
  const Status status = target->write_sheet(*sheet);
  return status ? code : report.fail(status.error());
}

}  // namespace

void add_snr(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "snr", "frames side by side, raw and in grey, with range in degC, noise and their ratio");
  auto command = std::make_shared<SnrCommand>();
  command->common.add_to(app);
  app.get_option("--output")->description("picture: .png, .svg or .pdf");
  app.add_option("--gain", command->grey_scale.gain, "grey levels per count of the 8-bit view")
      ->check(CLI::Range(1e-6, 1000.0))
      ->capture_default_str();
  app.add_option("--degc-per-count", command->degc_per_count, "worth of a count, degC")
      ->check(CLI::Range(1e-6, 1000.0))
      ->capture_default_str();
  FigureOutput::add_panel_width_to(app, command->panel_width);
  app.callback([command, &exit_code] { exit_code = command->draw(); });
}

}  // namespace thermedge::cli
