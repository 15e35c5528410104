#include "common.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <system_error>

#include "input.hpp"
#include "signal_guard.hpp"
#include "standard_output.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/io/source_options.hpp"
#include "thermedge/simd.hpp"

namespace thermedge::cli {
namespace {

// `name` in a directory, which is made where it is missing.
Result<std::string> in_directory(const std::filesystem::path& directory, const std::string& name) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    return failure(ErrorCode::kIo, fmt::format("{}: cannot be made a directory: {}",
                                               directory.string(), error.message()));
  }
  return (directory / name).string();
}

template <class Options>
Status apply_settings(const std::vector<std::string>& settings, Options& options,
                      io::SourceOptions& source) {
  for (const std::string& setting : settings) {
    Status status = io::is_source_setting(setting) ? io::apply_setting(setting, source)
                                                   : io::apply_setting(setting, options);
    if (!status) {
      status.error().message = "--set " + status.error().message;
      return status;
    }
  }
  return {};
}

tl::unexpected<Error> too_many_frames(const CommonOptions& common, std::size_t frames) {
  return failure(
      ErrorCode::kInvalidArgument,
      fmt::format("-o {}: has room for one frame, and the inputs hold {}; give a "
                  "directory: -o DIR",
                  common.output, frames > 0 ? std::to_string(frames) : std::string("several")));
}

// Frames one after the other, numbered over all inputs; errors of reading are reported on the way.
class FrameReader {
 public:
  FrameReader(std::unique_ptr<io::FrameSource> source, Console& report)
      : source_(std::move(source)), report_(report) {}

  // False at the end.
  bool next(io::SourceFrame& frame) {
    for (;;) {
      const auto more = source_->next(frame);
      if (more) {
        frame.index = static_cast<std::int64_t>(done_);
        done_ += *more ? 1 : 0;
        return *more;
      }
      report_.error(more.error().message);
      ++failures_;
      report_progress(++done_);
    }
  }
  void report_progress() { report_progress(done_); }
  [[nodiscard]] std::size_t size_hint() const { return source_->size_hint(); }
  [[nodiscard]] std::size_t done() const { return done_; }
  [[nodiscard]] std::size_t failures() const { return failures_; }

 private:
  void report_progress(std::size_t done) { report_.progress(done, source_->size_hint()); }

  std::unique_ptr<io::FrameSource> source_;
  Console& report_;
  std::size_t done_ = 0;  // those that cannot be read, too
  std::size_t failures_ = 0;
};

}  // namespace

void RunOptions::add_to(CLI::App& app) {
  app.add_option("--threads", threads, "threads (default 0: one per core)")
      ->check(CLI::Range(0, 1024));
  app.add_flag("--quiet", quiet, "errors only");
  app.add_flag("--json-log", json_log, "messages as JSON lines");
}

void CommonOptions::add_to(CLI::App& app) {
  app.add_option("INPUT", inputs,
                 "files (PNG, TIFF, PGM, NPY, FLIR JPEG, FFF and SEQ, raw), directories, globs, - "
                 "(raw frames on standard input), "
                 "sim:NAME[?seed=N&frames=N]")
      ->required();
  app.add_option("-o,--output", output, "file for one frame, directory for many");
  for (std::size_t i = 0; i < kSourceFlags.size(); ++i) {
    app.add_option(kSourceFlags[i].flag, source_flags[i], kSourceFlags[i].help)
        ->type_name(kSourceFlags[i].type);
  }
  app.add_option("--simd", simd, "instruction set: auto or a target's name")->capture_default_str();
  RunOptions::add_to(app);
}

void CommonOptions::add_validity_to(CLI::App& app) {
  app.add_option("--mask", validity.mask,
                 "8-bit picture of the frames' size, 0 where a pixel is no measurement");
  app.add_option("--invalid", validity.counts,
                 "count (of float frames a value) that means no measurement; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("COUNT");
}

Result<io::SourceOptions> CommonOptions::source_options(io::SourceOptions source) const {
  for (std::size_t i = 0; i < kSourceFlags.size(); ++i) {
    const Status status =
        source_flags[i] ? io::set_source_option(kSourceFlags[i].option, *source_flags[i], source)
                        : Status();
    if (!status) {
      return failure(status.error().code, fmt::format("{} {}: {}", kSourceFlags[i].flag,
                                                      *source_flags[i], status.error().message));
    }
  }
  return source;
}

Status CommonOptions::check() const {
  if (inputs.empty()) {
    return failure(ErrorCode::kInvalidArgument,
                   "INPUT is required: a file, directory, glob, - or sim:NAME (a word after an "
                   "option that takes a value is that value)");
  }
  if (const auto target = SimdTarget::named(simd); !target) {
    return failure(target.error().code, "--simd: " + target.error().message);
  }
  return {};
}

Result<io::SourceOptions> CommonOptions::prepare() const {
  return check().and_then([&] { return source_options(); });
}

InputFiles CommonOptions::input_files(const io::SourceOptions& source,
                                      const std::vector<std::string>& more) const {
  InputFiles files(inputs, source.raw_width > 0);
  files.add(validity.mask);
  for (const std::string& file : more) {
    files.add(file);
  }
  return files;
}

void ConfigOptions::add_to(CLI::App& app) {
  app.add_option("--config", file, "options from a TOML file");
  app.add_option("--set", settings,
                 "one option, stage.option=value (--dump-config lists them); may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--dump-config", dump, "print all options as TOML and stop");
}

Result<DetectorOptions> ConfigOptions::detector_options(const std::optional<std::string>& preset,
                                                        io::SourceOptions& source) const {
  constexpr std::string_view kPresetSetting = "preset=";
  std::vector<std::string> others;
  std::optional<std::string> chosen;
  for (const std::string& setting : settings) {
    if (setting.starts_with(kPresetSetting)) {
      chosen = setting.substr(kPresetSetting.size());
      if (!preset_named(*chosen)) {
        return failure(ErrorCode::kInvalidArgument,
                       fmt::format("--set {}: should be one of {}", setting,
                                   fmt::join(names_of(kPresets), ", ")));
      }
    } else {
      others.push_back(setting);
    }
  }
  chosen = preset ? preset : chosen;
  DetectorOptions options = chosen ? DetectorOptions(*preset_named(*chosen)) : DetectorOptions();
  const auto choice = chosen ? io::PresetChoice::kFixed : io::PresetChoice::kFree;
  Status status = file.empty() ? Status() : io::load_config(file, choice, options, &source);
  return status.and_then([&] { return apply_settings(others, options, source); }).map([&] {
    return options;
  });
}

Status ConfigOptions::apply(FrameDenoiserOptions& options, io::SourceOptions& source) const {
  Status status;
  if (!file.empty()) {
    status = io::load_config(file, options, &source);
  }
  return status.and_then([&] { return apply_settings(settings, options, source); });
}

Result<double> parse_sigma(const std::string& text) {
  if (text == "auto") {
    return 0.0;
  }
  double sigma = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, sigma);
  if (error != std::errc{} || stop != end || !(sigma > 0) || sigma > 65535) {
    return failure(ErrorCode::kInvalidArgument,
                   fmt::format("--sigma {}: should be auto or counts above 0", text));
  }
  return sigma;
}

int for_each_frame(const CommonOptions& common, const io::SourceOptions& source, Console& report,
                   Room room, const std::function<Status(const io::SourceFrame&)>& handle) {
  auto opened = open_inputs(common, source, report);
  if (!opened) {
    return report.fail(opened.error());
  }
  FrameReader frames(std::move(*opened), report);
  const std::size_t expected = frames.size_hint();
  if (room == Room::kOne && expected > 1) {
    return report.fail(too_many_frames(common, expected).value());
  }
  io::SourceFrame frame;
  io::SourceFrame second;  // read ahead where there is room for one
  std::size_t not_handled = 0;
  SignalGuard signals;
  signals.set_last_words(report.interruption_line(0, 0));
  while (frames.next(frame)) {
    if (room == Room::kOne && frames.next(second)) {
      return report.fail(too_many_frames(common, frames.size_hint()).value());
    }
    signals.begin_frame();
    if (const Status status = handle(frame); !status) {
      report.error(frame.source + ": " + status.error().message);
      ++not_handled;
    }
    if (standard_output_failed() || report.run_ended()) {
      return kBadInput;
    }
    frames.report_progress();
    signals.set_last_words(
        report.interruption_line(frames.done(), frames.failures() + not_handled));
    signals.end_frame();
  }
  report.summarize(frames.done(), frames.failures() + not_handled);
  return report.exit_code();
}

void OutputDirectory::begin_frame(const std::string& stem) {
  stem_ = stem;
  auto place = std::lower_bound(used_.begin(), used_.end(), stem_);
  for (int copy = 2; place != used_.end() && *place == stem_; ++copy) {
    stem_ = fmt::format("{}_{}", stem, copy);
    place = std::lower_bound(used_.begin(), used_.end(), stem_);
  }
  used_.insert(place, stem_);
}

Result<std::string> OutputDirectory::path(const std::string& kind, const std::string& ending) {
  const std::filesystem::path directory(directory_);
  return in_directory(kind.empty() ? directory : directory / kind, stem_ + ending)
      .and_then([&](const std::string& path) { return unless_input(path); });
}

Result<std::string> OutputDirectory::path_in_folder(const std::string& name) {
  return in_directory(std::filesystem::path(directory_) / stem_, name)
      .and_then([&](const std::string& path) { return unless_input(path); });
}

Result<std::string> OutputDirectory::unless_input(const std::string& path) const {
  return inputs_.check_file("-o", path).map([&] { return path; });
}

std::vector<std::string> split_list(const std::string& list) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= list.size()) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    if (comma > begin) {
      parts.push_back(list.substr(begin, comma - begin));
    }
    begin = comma + 1;
  }
  return parts;
}

}  // namespace thermedge::cli
