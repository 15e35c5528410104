#include "common.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

#include "input.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/simd.hpp"

namespace thermedge::cli {
namespace {

Status parse_size(const std::string& text, io::SourceOptions& options) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, options.raw_width);
  if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, options.raw_height);
    if (height.ec == std::errc{} && height.ptr == end && options.raw_width > 0 &&
        options.raw_height > 0) {
      return {};
    }
  }
  return failure(ErrorCode::kInvalidArgument,
                 fmt::format("--raw-size {}: should be WIDTHxHEIGHT, e.g. 382x288", text));
}

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
Status apply_settings(const std::vector<std::string>& settings, Options& options) {
  for (const std::string& setting : settings) {
    if (Status status = io::apply_setting(setting, options); !status) {
      status.error().message = "--set " + status.error().message;
      return status;
    }
  }
  return {};
}

}  // namespace

void RunOptions::add_to(CLI::App& app) {
  app.add_option("--threads", threads, "threads (0: one per core)")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--quiet", quiet, "errors only");
  app.add_flag("--json-log", json_log, "messages as JSON lines");
}

void CommonOptions::add_to(CLI::App& app) {
  app.add_option("INPUT", inputs,
                 "picture files, directories, globs, .raw files, - (standard input), "
                 "sim:NAME[?seed=N&frames=N]")
      ->required();
  app.add_option("-o,--output", output, "file for one frame, directory for many");
  app.add_option("--raw-size", raw_size, "size of headerless frames, WIDTHxHEIGHT");
  app.add_option("--raw-format", raw_format, "pixels of headerless frames")
      ->check(CLI::IsMember({"gray16le", "gray16be", "gray8"}))
      ->capture_default_str();
  app.add_option("--simd", simd, "instruction set: auto or a target's name")->capture_default_str();
  RunOptions::add_to(app);
}

void CommonOptions::add_validity_to(CLI::App& app) {
  app.add_option("--mask", validity.mask,
                 "8-bit picture of the frames' size, 0 where a pixel is no measurement");
  app.add_option("--invalid", validity.counts,
                 "count that means no measurement, 0..65535; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("COUNT");
}

Result<io::SourceOptions> CommonOptions::prepare() const {
  if (inputs.empty()) {
    return failure(ErrorCode::kInvalidArgument,
                   "INPUT is required: a file, directory, glob, - or sim:NAME");
  }
  io::SourceOptions options;
  options.raw_format = raw_format == "gray16be" ? io::RawFormat::kGray16Be
                       : raw_format == "gray8"  ? io::RawFormat::kGray8
                                                : io::RawFormat::kGray16Le;
  if (!raw_size.empty()) {
    if (Status status = parse_size(raw_size, options); !status) {
      return tl::unexpected(status.error());
    }
  }
  const auto target = SimdTarget::named(simd);
  if (!target) {
    return failure(target.error().code, "--simd: " + target.error().message);
  }
  return options;
}

void ConfigOptions::add_to(CLI::App& app) {
  app.add_option("--config", file, "options from a TOML file");
  app.add_option("--set", settings, "one option, stage.option=value; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--dump-config", dump, "print all options as TOML and stop");
}

Status ConfigOptions::apply(io::PresetChoice choice, DetectorOptions& options) const {
  Status status;
  if (!file.empty()) {
    status = io::load_config(file, choice, options);
  }
  return status.and_then([&] { return apply_settings(settings, options); });
}

Status ConfigOptions::apply(FrameDenoiserOptions& options) const {
  Status status;
  if (!file.empty()) {
    status = io::load_config(file, options);
  }
  return status.and_then([&] { return apply_settings(settings, options); });
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
                   const std::function<Status(const io::SourceFrame&)>& handle) {
  const auto opened = open_inputs(common.inputs, source, common.validity);
  if (!opened) {
    return report.fail(opened.error());
  }
  const auto& frames = *opened;
  io::SourceFrame frame;
  for (std::size_t done = 1;; ++done) {
    const auto more = frames->next(frame);
    if (!more) {
      report.error(more.error().message);
    } else if (!*more) {
      return report.exit_code();
    } else if (const Status status = handle(frame); !status) {
      report.error(frame.source + ": " + status.error().message);
    }
    report.progress(done, frames->size_hint());
  }
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
  return in_directory(kind.empty() ? directory : directory / kind, stem_ + ending);
}

Result<std::string> OutputDirectory::path_in_folder(const std::string& name) {
  return in_directory(std::filesystem::path(directory_) / stem_, name);
}

tl::unexpected<Error> only_one_frame(const std::string& output) {
  return failure(ErrorCode::kInvalidArgument,
                 output + " holds the first frame; for several give -o DIR");
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
