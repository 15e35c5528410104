#include <fmt/core.h>

#include <memory>

#include "commands.hpp"
#include "detector_command.hpp"
#include "result_writer.hpp"

namespace thermedge::cli {
namespace {

struct EdgeCommand : DetectorCommand {
  std::string write;

  void add_to(CLI::App& app);
};

void EdgeCommand::add_to(CLI::App& app) {
  DetectorCommand::add_to(app);
  app.add_option("--write", write,
                 "for -o DIR: mask,strength,labels,json,svg,overlay,distance (default mask)");
}

// Runs `step(detector, frame)` on each frame and writes the result.
template <class Step>
int run(const EdgeCommand& command, Step&& step) {
  return command.run([&](const DetectorOptions& options, const io::SourceOptions& source,
                         Console& report) {
    auto writer = ResultWriter::create(command.common.output, command.write);
    if (!writer) {
      return report.fail(writer.error());
    }
    auto detector = Detector::create(options);
    if (!detector) {
      return report.fail(detector.error());
    }
    const std::string preset(preset_name(options.preset));
    return for_each_frame(command.common, source, report, [&](const io::Frame& frame) -> Status {
      return step(*detector, frame).and_then([&](const Detection* detection) {
        return writer->write(*detection, {frame.source, preset}, frame.stem);
      });
    });
  });
}

}  // namespace

void add_detect(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand("detect", "find edges in frames");
  auto command = std::make_shared<EdgeCommand>();
  command->add_to(app);
  command->add_denoising_to(app);
  app.callback([command, &exit_code] {
    exit_code = run(*command, [](Detector& detector, const io::Frame& frame) {
      return detector.detect(frame.counts, frame.bits);
    });
  });
}

void add_trace(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "trace", "contours, corners, links and ranks of somebody else's binary edge maps");
  auto command = std::make_shared<EdgeCommand>();
  command->add_to(app);
  app.callback([command, &exit_code] {
    exit_code = run(*command, [map = Image<std::uint8_t>()](Detector& detector,
                                                            const io::Frame& frame) mutable {
      map.resize(frame.counts.width(), frame.counts.height());
      for (int y = 0; y < map.height(); ++y) {
        std::transform(frame.counts.row(y), frame.counts.row(y) + map.width(), map.row(y),
                       [](std::uint16_t value) { return std::uint8_t{value != 0}; });
      }
      return detector.trace(map);
    });
  });
}

}  // namespace thermedge::cli
