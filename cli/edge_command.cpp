#include "edge_command.hpp"

#include <algorithm>
#include <vector>

#include "clipping_warning.hpp"
#include "result_writer.hpp"

namespace thermedge::cli {

void EdgeCommand::add_to(CLI::App& app) {
  DetectorCommand::add_to(app);
  app.add_option("--write", write,
                 "for -o DIR: mask,strength,labels,json,svg,overlay,distance (default mask)");
  app.add_flag("--explain", explain,
               "overlays show dropped edges too, with a legend of why each was dropped");
}

Status EdgeCommand::check_explain() const {
  const std::vector<std::string> kinds = split_list(write);
  if (explain && std::find(kinds.begin(), kinds.end(), "overlay") == kinds.end()) {
    return failure(ErrorCode::kInvalidArgument, "--explain needs --write overlay");
  }
  return {};
}

int EdgeCommand::run_on_frames(const Step& step) const {
  return run(
      [&](const DetectorOptions& options, const io::SourceOptions& source, Console& console) {
        auto writer =
            ResultWriter::create(common.output, write, common.input_files(source, {config.file}));
        if (!writer) {
          return console.fail(writer.error());
        }
        if (const Status status = check_explain(); !status) {
          return console.fail(status.error());
        }
        writer->explain_overlays(explain);
        auto detector = Detector::create(options);
        if (!detector) {
          return console.fail(detector.error());
        }
        const PaperOptions* paper = options.paper();
        ClippingWarning clipping("--set grey_scale.gain=", paper ? paper->grey_scale.gain : 0,
                                 ", and --preset robust or fast scale nothing");
        Detection detection;
        return for_each_frame(
            common, source, console, writer->room(), [&](const io::SourceFrame& frame) {
              return step(*detector, frame, detection).and_then([&] {
                clipping.frame(frame.source, frame.counts, detection.clipped, console);
                return writer->write(detection, frame.counts, frame.source, frame.stem);
              });
            });
      });
}

}  // namespace thermedge::cli
