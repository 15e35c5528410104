// `scale`: 16 bits to 8 bits.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "clipping_warning.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "line_file.hpp"
#include "picture_output.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/radiometry/stable_grey_scale.hpp"

namespace thermedge::cli {
namespace {

struct ScaleCommand {
  CommonOptions common;
  std::optional<double> gain;
  bool stable = false;
  StableGreyScaleOptions view;

  [[nodiscard]] int run();

 private:
  [[nodiscard]] Status write(const io::SourceFrame& frame, ImageView<std::uint8_t> levels,
                             PictureOutput& output) const;
  [[nodiscard]] bool passes_as_it_is(const io::SourceFrame& frame, Console& report);
  [[nodiscard]] Status write_as_it_is(const io::SourceFrame& frame, PictureOutput& output) const;
  [[nodiscard]] int run_algorithm1(const io::SourceOptions& source, Console& report,
                                   PictureOutput& output);
  [[nodiscard]] int run_stable(const io::SourceOptions& source, Console& report,
                               PictureOutput& output);

  bool note_is_said_ = false;
};

Status ScaleCommand::write(const io::SourceFrame& frame, ImageView<std::uint8_t> levels,
                           PictureOutput& output) const {
  return output.path(frame.stem).and_then([&](const std::string& path) {
    return io::write_picture(path, ImageView<const std::uint8_t>(levels));
  });
}

// Frames of 8 bits are grey levels already. Says so once.
bool ScaleCommand::passes_as_it_is(const io::SourceFrame& frame, Console& report) {
  if (frame.bits != 8) {
    return false;
  }
  if (!note_is_said_) {
    note_is_said_ = true;
    report.note(frame.source + ": 8-bit frames are grey levels already and are written unchanged" +
                (gain ? "; --gain does not apply to them" : ""));
  }
  return true;
}

Status ScaleCommand::write_as_it_is(const io::SourceFrame& frame, PictureOutput& output) const {
  Image<std::uint8_t> levels(frame.width(), frame.height());
  for (int y = 0; y < levels.height(); ++y) {
    std::transform(frame.counts.row(y), frame.counts.row(y) + levels.width(), levels.row(y),
                   [](std::uint16_t level) { return static_cast<std::uint8_t>(level); });
  }
  return write(frame, levels, output);
}

// Of a float frame in degrees, gain is in levels a hundredth of a degree, as that of counts.
GreyScaleOptions for_frame(GreyScaleOptions options, const io::SourceFrame& frame) {
  constexpr double kCountsPerUnit = 100;
  if (frame.is_float() && frame.scale.counts_per_unit != 1) {
    options.gain *= kCountsPerUnit / frame.scale.counts_per_unit;
  }
  return options;
}

int ScaleCommand::run_algorithm1(const io::SourceOptions& source, Console& report,
                                 PictureOutput& output) {
  GreyScaleOptions options;
  options.gain = gain.value_or(options.gain);
  if (const Status status = options.check(); !status) {
    return report.fail(status.error());
  }
  ClippingWarning clipping("--gain ", options.gain, "");
  Image<std::uint8_t> levels;
  return for_each_frame(
      common, source, report, output.room(), [&](const io::SourceFrame& frame) -> Status {
        if (passes_as_it_is(frame, report)) {
          return write_as_it_is(frame, output);
        }
        const GreyScaleOptions scaled = for_frame(options, frame);
        levels.resize(frame.width(), frame.height());
        if (!frame.is_float()) {
          clipping.frame(frame.source, frame.counts, clipped_shares(frame.counts, scaled), report);
        }
        return scale_to_8bit(frame.counts, scaled, levels).and_then([&] {
          return write(frame, levels, output);
        });
      });
}

std::string_view event_name(GreyScaleEvent event) {
  switch (event) {
    case GreyScaleEvent::kNone:
      break;
    case GreyScaleEvent::kStart:
      return "start";
    case GreyScaleEvent::kSceneCut:
      return "scene_cut";
  }
  return "";
}

std::string state_line(const io::SourceFrame& frame, const GreyScaleState& state) {
  using Json = nlohmann::ordered_json;
  const std::string_view event = event_name(state.event);
  const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
  const Json line = {{"format_version", io::kFormatVersion},
                     {"source", frame.source},
                     {"frame", frame.index},
                     {"stamp_ns", frame.stamp_ns ? Json(*frame.stamp_ns) : Json(nullptr)},
                     {"gain", rounded(state.gain)},
                     {"offset", rounded(state.offset)},
                     {"clipped_low_share", rounded(state.clipped_low_share)},
                     {"clipped_high_share", rounded(state.clipped_high_share)},
                     {"event", event.empty() ? Json(nullptr) : Json(event)}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// How many frames of a sequence lose much.
class ClippedFrames {
 public:
  void add(const std::string& source, double share) {
    ++frames_;
    if (share > kMuchClippedShare) {
      ++clipped_;
    }
    if (share > most_) {
      most_ = share;
      source_ = source;
    }
  }

  void warn(bool gain_is_given, Console& console) const {
    if (clipped_ == 0) {
      return;
    }
    console.warn(
        fmt::format("frames with more than {:g} % of their pixels clipped: {} of {}; the most, "
                    "{:.1f} %, in {}{}",
                    100 * kMuchClippedShare, clipped_, frames_, 100 * most_, source_,
                    gain_is_given ? "; a smaller --gain, or none, clips less" : ""));
  }

 private:
  std::size_t frames_ = 0;
  std::size_t clipped_ = 0;
  double most_ = 0;
  std::string source_;  // of the frame that loses most
};

int ScaleCommand::run_stable(const io::SourceOptions& source, Console& report,
                             PictureOutput& output) {
  StableGreyScaleOptions options = view;
  options.gain = gain.value_or(options.gain);
  if (const Status status = check_options(options); !status) {
    return report.fail(status.error());
  }
  const auto state_file = output.beside("scale.jsonl");
  if (!state_file) {
    return report.fail(state_file.error());
  }
  StableGreyScale stable_grey_scale(options);
  ClippedFrames clipped;
  Image<std::uint8_t> levels;
  LineFile lines(*state_file);
  const int code = for_each_frame(
      common, source, report, output.room(), [&](const io::SourceFrame& frame) -> Status {
        if (passes_as_it_is(frame, report)) {
          return write_as_it_is(frame, output).and_then([&] {
            return report.or_end_run(lines.write(state_line(frame, {.gain = 1})));
          });
        }
        levels.resize(frame.width(), frame.height());
        return stable_grey_scale.run(frame.counts, levels)
            .and_then([&](const GreyScaleState& state) {
              clipped.add(frame.source, state.clipped_low_share + state.clipped_high_share);
              return write(frame, levels, output).and_then([&] {
                return report.or_end_run(lines.write(state_line(frame, state)));
              });
            });
      });
  clipped.warn(options.gain > 0, report);
  return code;
}

int ScaleCommand::run() {
  Console report = common.report();
  const auto source = common.prepare();
  if (!source) {
    return report.fail(source.error());
  }
  auto output = PictureOutput::create(common.output, common.input_files(*source));
  if (!output) {
    return report.fail(output.error());
  }
  report.set_results(common.output);
  return stable ? run_stable(*source, report, *output) : run_algorithm1(*source, report, *output);
}

}  // namespace

void add_scale(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "scale", "16-bit frames to 8-bit pictures at a constant number of degrees per grey level");
  auto command = std::make_shared<ScaleCommand>();
  command->common.add_to(app);
  app.get_option("-o")->required();
  app.add_option(
         "--gain", command->gain,
         "grey levels per count (default 0.5; with --stable 0: chosen from range and noise)")
      ->check(CLI::Range(0.0, 1000.0));
  CLI::Option* stable = app.add_flag(
      "--stable", command->stable,
      "for sequences: gain and offset are held and follow slowly, so that the picture does not "
      "flicker; both are written to scale.jsonl");
  app.add_option("--dead-band", command->view.dead_band_levels,
                 "grey levels by which the median may move before the view follows")
      ->check(CLI::Range(0.0, 127.0))
      ->capture_default_str()
      ->needs(stable);
  app.add_option("--slew", command->view.slew_levels,
                 "grey levels by which the view may move from frame to frame")
      ->check(CLI::Range(0.0, 255.0))
      ->capture_default_str()
      ->needs(stable);
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

}  // namespace thermedge::cli
