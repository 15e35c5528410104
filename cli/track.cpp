// `track`: frames to edges with identities.
#include <fmt/core.h>

#include <memory>

#include "commands.hpp"
#include "detector_command.hpp"
#include "thermedge/sequence/sequence_detector.hpp"
#include "track_writer.hpp"

namespace thermedge::cli {
namespace {

struct TrackCommand : DetectorCommand {
  std::string write;
  bool lines_only = false;
  SequenceOptions sequence;

  void add_to(CLI::App& app);
  [[nodiscard]] int run_on_frames() const;
};

void TrackCommand::add_to(CLI::App& app) {
  DetectorCommand::add_to(app);
  app.get_option("--output")
      ->description(
          "file of all frames (.jsonl or .csv), directory, or - for JSON lines on standard output");
  add_denoising_to(app);
  common.add_validity_to(app);
  app.add_option("--write", write, "for -o DIR: json,csv,overlay,distance (default json)");
  app.add_flag("--lines-only", lines_only, "overlays without the frame: lines on black");
  app.add_option("--rate", sequence.tracker.rate_hz,
                 "frames a second, where the source has no time stamps")
      ->capture_default_str();
  app.add_option("--coast", sequence.tracker.coast_s,
                 "how long an edge that is not found is followed, s")
      ->capture_default_str();
}

int TrackCommand::run_on_frames() const {
  return run([&](const DetectorOptions& options, const io::SourceOptions& source,
                 Console& console) {
    auto writer = TrackWriter::create(common.output, write, common.quiet,
                                      common.input_files(source, {config.file}));
    if (!writer) {
      return console.fail(writer.error());
    }
    if (lines_only && !writer->draws_overlays()) {
      return console.fail(
          {ErrorCode::kInvalidArgument, "--lines-only: is for overlays: -o DIR --write overlay"});
    }
    SequenceOptions all = sequence;
    all.detector = options;
    auto detector = SequenceDetector::create(all);
    if (!detector) {
      return console.fail(detector.error());
    }
    console.set_results(writer->place());
    TrackedFrame result;
    int width = 0;
    int height = 0;
    return for_each_frame(common, source, console, Room::kMany, [&](const io::SourceFrame& frame) {
      if (width > 0 && (frame.width() != width || frame.height() != height)) {
        console.warn(fmt::format("{}: {}x{} pixels after {}x{}: a new sequence begins",
                                 frame.source, frame.width(), frame.height(), width, height));
      }
      width = frame.width();
      height = frame.height();
      return detector->process(frame.frame(), result).and_then([&] {
        console.add_edges(result.detection.edges.kept);
        const auto background = lines_only ? ImageView<const std::uint16_t>() : frame.counts.view();
        return console.or_end_run(writer->write(result, background, frame.source, frame.stem));
      });
    });
  });
}

}  // namespace

void add_track(CLI::App& program, int& exit_code) {
  CLI::App& app =
      *program.add_subcommand("track", "follow edges over the frames of a recording or stream");
  auto command = std::make_shared<TrackCommand>();
  command->add_to(app);
  app.callback([command, &exit_code] { exit_code = command->run_on_frames(); });
}

}  // namespace thermedge::cli
