// `bench`: will this machine keep up with the camera?
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "detector_command.hpp"
#include "input.hpp"
#include "standard_output.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/simd.hpp"

namespace thermedge::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Times of one stage over the timed frames.
struct Samples {
  std::string name;
  std::vector<double> ms;

  // The smallest sample that `share` of them do not exceed. Sorts them.
  [[nodiscard]] double quantile(double share) {
    std::sort(ms.begin(), ms.end());
    const double rank = std::ceil(share * static_cast<double>(ms.size()));
    return ms[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  }
};

struct BenchResult {
  int width = 0, height = 0, threads = 0;
  std::string simd;
  std::size_t memory_bytes = 0;
  std::vector<Samples> stages;  // and the whole frame as the last
  [[nodiscard]] std::size_t frames() const { return stages.back().ms.size(); }
};

struct BenchCommand : DetectorCommand {
  int most_frames = 64;
  double seconds = 5;
  bool json = false;

  [[nodiscard]] int time_stages() const;
  [[nodiscard]] std::vector<io::SourceFrame> read(const io::SourceOptions& source,
                                                  Console& report) const;
  [[nodiscard]] Result<BenchResult> time(const std::vector<io::SourceFrame>& frames,
                                         const DetectorOptions& options) const;
};

// Frames of one size, in memory, so that files are not timed.
std::vector<io::SourceFrame> BenchCommand::read(const io::SourceOptions& source,
                                                Console& report) const {
  std::vector<io::SourceFrame> frames;
  const auto opened = open_inputs(common, source, report);
  if (!opened) {
    report.error(opened.error().message);
    return frames;
  }
  const auto& input = *opened;
  while (frames.size() < static_cast<std::size_t>(most_frames)) {
    io::SourceFrame frame;
    const auto more = input->next(frame);
    if (!more) {
      report.error(more.error().message);
    } else if (!*more) {
      break;
    } else if (!frames.empty() && !same_size(frame.counts.view(), frames[0].counts.view())) {
      report.error(fmt::format("{}: {}x{} pixels, where the first frame has {}x{}; left out",
                               frame.source, frame.counts.width(), frame.counts.height(),
                               frames[0].counts.width(), frames[0].counts.height()));
    } else {
      frames.push_back(std::move(frame));
    }
  }
  return frames;
}

Result<BenchResult> BenchCommand::time(const std::vector<io::SourceFrame>& frames,
                                       const DetectorOptions& options) const {
  auto detector = Detector::create(options);
  if (!detector) {
    return tl::unexpected(detector.error());
  }
  BenchResult result;
  result.width = frames[0].counts.width();
  result.height = frames[0].counts.height();
  result.threads = detector->threads();
  result.simd = SimdTarget::named(options.simd)->name();
  Detection detection;

  constexpr std::size_t kWarmUp = 2;  // frames after which nothing is allocated any more
  Clock::time_point start;
  for (std::size_t i = 0;; ++i) {
    if (i == kWarmUp) {
      start = Clock::now();
    } else if (i >= kWarmUp + frames.size() && ms_since(start) >= 1000 * seconds) {
      result.memory_bytes = detector->memory_bytes();
      return result;
    }
    const io::SourceFrame& frame = frames[i % frames.size()];
    const auto before = Clock::now();
    const Status status = detector->detect(frame.frame(), detection);
    const double total = ms_since(before);
    if (!status) {
      return tl::unexpected(status.error());
    }
    if (result.stages.empty()) {
      for (const StageTime& time : detection.times) {
        result.stages.push_back({std::string(time.stage), {}});
      }
      result.stages.push_back({"total", {}});
    }
    if (i >= kWarmUp) {
      for (std::size_t s = 0; s < detection.times.size(); ++s) {
        result.stages[s].ms.push_back(detection.times[s].ms);
      }
      result.stages.back().ms.push_back(total);
    }
  }
}

Json times(Samples& samples) {
  const auto rounded = [](double ms) { return std::round(1e4 * ms) / 1e4; };
  return {{"median_ms", rounded(samples.quantile(0.5))},
          {"p99_ms", rounded(samples.quantile(0.99))}};
}

std::string json_text(BenchResult& result) {
  Json stages = Json::object();
  for (std::size_t i = 0; i + 1 < result.stages.size(); ++i) {
    stages[result.stages[i].name] = times(result.stages[i]);
  }
  const double fps = 1000 / result.stages.back().quantile(0.5);
  const Json document = {{"format_version", io::kFormatVersion},
                         {"width", result.width},
                         {"height", result.height},
                         {"threads", result.threads},
                         {"simd", result.simd},
                         {"memory_bytes", result.memory_bytes},
                         {"frames", result.frames()},
                         {"stages", stages},
                         {"total", times(result.stages.back())},
                         {"fps", std::round(100 * fps) / 100}};
  return document.dump() + "\n";
}

std::string table(BenchResult& result) {
  std::string text = fmt::format(
      "{}x{} pixels, {} thread{}, {}, {:.1f} MB of scratch memory, {} frame{} timed\n\n",
      result.width, result.height, result.threads, result.threads == 1 ? "" : "s", result.simd,
      static_cast<double>(result.memory_bytes) / 1e6, result.frames(),
      result.frames() == 1 ? "" : "s");
  text += fmt::format("{:<14}{:>12}{:>12}\n", "stage", "median ms", "p99 ms");
  for (Samples& stage : result.stages) {
    text += fmt::format("{:<14}{:>12.3f}{:>12.3f}\n", stage.name, stage.quantile(0.5),
                        stage.quantile(0.99));
  }
  Samples& total = result.stages.back();
  return text +
         fmt::format(
             "\n{:.1f} frames a second; 99 of 100 frames are ready in time for a camera of {:.1f} "
             "Hz\n",
             1000 / total.quantile(0.5), 1000 / total.quantile(0.99));
}

int BenchCommand::time_stages() const {
  return run([&](const DetectorOptions& options, const io::SourceOptions& source, Console& report) {
    if (!common.output.empty()) {
      return report.fail({ErrorCode::kInvalidArgument,
                          "-o: bench prints on standard output; redirect it to a file"});
    }
    const std::vector<io::SourceFrame> frames = read(source, report);
    if (frames.empty()) {
      return report.exit_code();
    }
    auto result = time(frames, options);
    if (!result) {
      return report.fail(result.error());
    }
    print(json ? json_text(*result) : table(*result));
    return report.exit_code();
  });
}

}  // namespace

void add_bench(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "bench", "time of every stage on these frames on this machine, and frames per second");
  auto command = std::make_shared<BenchCommand>();
  command->add_to(app);
  command->add_denoising_to(app);
  command->common.add_validity_to(app);
  app.add_option("--frames", command->most_frames, "frames read into memory, at most")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--seconds", command->seconds, "repeats the frames for this time, at least once")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  app.add_flag("--json", command->json, "one JSON object instead of the table");
  app.callback([command, &exit_code] { exit_code = command->time_stages(); });
}

}  // namespace thermedge::cli
