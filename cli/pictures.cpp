// `scale` and `denoise`: a picture in, a picture out.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.hpp"
#include "common.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/radiometry/stable_grey_scale.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/noise.hpp"
#include "thermedge/stages/preprocessor.hpp"

namespace thermedge::cli {
namespace {

constexpr std::string_view kPictureEndings[] = {".png", ".tif", ".tiff", ".pgm", ".npy", ".raw"};

// The file of each result: OUT itself where it has a picture's ending, else OUT/<stem>.png.
class PictureOutput {
 public:
  explicit PictureOutput(const std::string& output) : output_(output), directory_(output) {
    const std::string ending = std::filesystem::path(output).extension().string();
    one_file_ = std::find(std::begin(kPictureEndings), std::end(kPictureEndings), ending) !=
                std::end(kPictureEndings);
  }

  Result<std::string> path(const std::string& stem) {
    if (!one_file_) {
      directory_.begin_frame(stem);
      return directory_.path("", ".png");
    }
    if (++written_ > 1) {
      return only_one_frame(output_);
    }
    return output_;
  }

  // A file for the whole run: in the directory, or beside the one picture with its name in front.
  [[nodiscard]] std::string beside(const std::string& name) const {
    const std::filesystem::path output(output_);
    return one_file_ ? (output.parent_path() / (output.stem().string() + "_" + name)).string()
                     : (output / name).string();
  }

 private:
  std::string output_;
  OutputDirectory directory_;
  bool one_file_ = false;
  int written_ = 0;
};

struct ScaleCommand {
  CommonOptions common;
  std::optional<double> gain;
  bool stable = false;
  StableGreyScaleOptions view;

  [[nodiscard]] int run() const;

 private:
  [[nodiscard]] Status write(const io::Frame& frame, ImageView<std::uint8_t> levels,
                             PictureOutput& output) const;
  [[nodiscard]] int run_algorithm1(const io::SourceOptions& source, Console& report) const;
  [[nodiscard]] int run_stable(const io::SourceOptions& source, Console& report) const;
};

Status ScaleCommand::write(const io::Frame& frame, ImageView<std::uint8_t> levels,
                           PictureOutput& output) const {
  return output.path(frame.stem).and_then([&](const std::string& path) {
    return io::write_picture(path, ImageView<const std::uint8_t>(levels));
  });
}

int ScaleCommand::run_algorithm1(const io::SourceOptions& source, Console& report) const {
  GreyScaleOptions options;
  options.gain = gain.value_or(options.gain);
  if (const Status status = check_ranges(options, "scale."); !status) {
    return report.fail(status.error());
  }
  PictureOutput output(common.output);
  Image<std::uint8_t> levels;
  return for_each_frame(common, source, report, [&](const io::Frame& frame) -> Status {
    levels.resize(frame.counts.width(), frame.counts.height());
    return scale_to_8bit(frame.counts, options, levels).and_then([&] {
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

std::string state_line(const io::Frame& frame, std::int64_t index, const GreyScaleState& state) {
  const std::string_view event = event_name(state.event);
  const nlohmann::ordered_json line = {
      {"source", frame.source},
      {"index", index},
      {"gain", state.gain},
      {"offset", state.offset},
      {"clipped_low_share", state.clipped_low_share},
      {"clipped_high_share", state.clipped_high_share},
      {"event", event.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(event)}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// What the view did with each frame is written even where some frames were bad.
int ScaleCommand::run_stable(const io::SourceOptions& source, Console& report) const {
  StableGreyScaleOptions options = view;
  options.gain = gain.value_or(options.gain);
  if (const Status status = check_options(options); !status) {
    return report.fail(status.error());
  }
  PictureOutput output(common.output);
  StableGreyScale stable_grey_scale(options);
  Image<std::uint8_t> levels;
  std::string lines;
  std::int64_t index = 0;
  const int code = for_each_frame(common, source, report, [&](const io::Frame& frame) -> Status {
    levels.resize(frame.counts.width(), frame.counts.height());
    return stable_grey_scale.run(frame.counts, levels).and_then([&](const GreyScaleState& state) {
      lines += state_line(frame, index++, state);
      return write(frame, levels, output);
    });
  });
  const Status status = io::write_file(output.beside("scale.jsonl"), lines);
  return status ? code : report.fail(status.error());
}

int ScaleCommand::run() const {
  Console report = common.report();
  const auto source = common.prepare();
  if (!source) {
    return report.fail(source.error());
  }
  return stable ? run_stable(*source, report) : run_algorithm1(*source, report);
}

// Corrections, noise, denoiser: counts in, counts out.
class CountsDenoiser {
 public:
  CountsDenoiser(const DetectorOptions& options, int threads)
      : told_sigma_(options.denoise.sigma_counts),
        runner_(make_runner(threads)),
        corrector_(options.nuc),
        denoiser_(options.denoise) {}

  Result<ImageView<const std::uint16_t>> run(ImageView<const std::uint16_t> frame) {
    counts_.resize(frame.width(), frame.height());
    working_.resize(frame.width(), frame.height());
    const double measured = estimator_.measure(frame).sigma_counts;
    copy_pixels(corrector_.run(frame, measured, *runner_), working_.view());
    const double sigma = told_sigma_ > 0 ? told_sigma_ : measured;
    return denoiser_.run_measured(working_, sigma, working_, *runner_).map([&] {
      round_to_counts(working_, counts_);
      return ImageView<const std::uint16_t>(counts_.view());
    });
  }

 private:
  double told_sigma_;
  std::unique_ptr<ParallelRunner> runner_;
  NoiseEstimator estimator_;
  Preprocessor corrector_;
  Denoiser denoiser_;
  Image<std::uint16_t> counts_;
  Image<float> working_;
};

// With the bits that the frame came with.
Status write_counts(const std::string& path, ImageView<const std::uint16_t> counts, int bits) {
  if (bits == 16) {
    return io::write_picture(path, counts);
  }
  Image<std::uint8_t> levels(counts.width(), counts.height());
  for (int y = 0; y < counts.height(); ++y) {
    std::transform(counts.row(y), counts.row(y) + counts.width(), levels.row(y),
                   [](std::uint16_t count) {
                     return static_cast<std::uint8_t>(std::min<std::uint16_t>(count, 255));
                   });
  }
  return io::write_picture(path, ImageView<const std::uint8_t>(levels.view()));
}

// A picture is to be as near to the frame without its noise as the method can make it. The presets'
// denoisers are stronger and even out flat areas, which helps edges and costs 0.5 to 0.9 dB here;
// their removal of stripes takes faint columns and rows of the scene along.
DetectorOptions picture_denoise_options() {
  DetectorOptions options;
  options.nuc = {};
  options.denoise = {};
  options.denoise.bm3d.profile = Bm3dProfile::kQuality;
  return options;
}

struct DenoiseCommand {
  CommonOptions common;
  ConfigOptions config;
  std::optional<std::string> method;
  std::string sigma = "auto";

  Status options(DetectorOptions& options) const {
    if (Status status = config.apply(options); !status) {
      return status;
    }
    if (method) {
      if (Status status = io::apply_setting("denoise.method=" + *method, options); !status) {
        return status;
      }
    }
    return parse_sigma(sigma).map([&](double counts) {
      options.denoise.sigma_counts = counts > 0 ? counts : options.denoise.sigma_counts;
    });
  }

  int run() const {
    Console report = common.report();
    DetectorOptions chosen = picture_denoise_options();
    if (const Status status = options(chosen); !status) {
      return report.fail(status.error());
    }
    if (config.dump) {
      fmt::print("{}", io::dump_config(chosen));
      return kGood;
    }
    const auto source = common.prepare();
    if (!source) {
      return report.fail(source.error());
    }
    PictureOutput output(common.output);
    CountsDenoiser denoiser(chosen, common.threads);
    return for_each_frame(common, *source, report, [&](const io::Frame& frame) -> Status {
      return denoiser.run(frame.counts).and_then([&](ImageView<const std::uint16_t> counts) {
        return output.path(frame.stem).and_then([&](const std::string& path) {
          return write_counts(path, counts, frame.bits);
        });
      });
    });
  }
};

}  // namespace

void add_scale(CLI::App& program, int& exit_code) {
  CLI::App& app =
      *program.add_subcommand("scale", "16 bit to 8 bit at constant degrees per grey level");
  auto command = std::make_shared<ScaleCommand>();
  command->common.add_to(app);
  app.get_option("-o")->required();
  app.add_option("--gain", command->gain,
                 "grey levels per count (default 0.5; with --stable 0.2, and 0: from the noise)")
      ->check(CLI::Range(0.0, 1000.0));
  CLI::Option* stable = app.add_flag(
      "--stable", command->stable,
      "a view that does not flicker: its centre is held; gain, offset and events in scale.jsonl");
  app.add_option("--dead-band", command->view.dead_band_levels,
                 "levels that the median may move before the view follows")
      ->check(CLI::Range(0.0, 127.0))
      ->capture_default_str()
      ->needs(stable);
  app.add_option("--slew", command->view.slew_levels, "levels a frame that the view may move")
      ->check(CLI::Range(0.0, 255.0))
      ->capture_default_str()
      ->needs(stable);
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

void add_denoise(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "denoise", "frames with less noise, in counts; slower and finer than what detect does");
  auto command = std::make_shared<DenoiseCommand>();
  command->common.add_to(app);
  command->config.add_to(app);
  app.get_option("-o")->required();
  app.add_option("--method", command->method, "denoiser (default bm3d)")
      ->check(CLI::IsMember(names_of(kDenoiseMethods)));
  app.add_option("--sigma", command->sigma, "noise: auto or counts")->capture_default_str();
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

}  // namespace thermedge::cli
