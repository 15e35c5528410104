#include "edge_command.hpp"

#include <algorithm>
#include <vector>

#include "clipping_warning.hpp"
#include "result_writer.hpp"

namespace thermedge::cli {

void EdgeCommand::add_to(CLI::App& app) {
  DetectorCommand::add_to(app);
  app.get_option("--output")
      ->description(
          "file (.png, .json and .svg: of one frame; .jsonl and .csv: of all), directory, or - for "
          "JSON "
          "lines on standard output");
  app.add_option("--write", write,
                 "for -o DIR: mask,strength,labels,json,csv,svg,overlay,distance (default mask)");
  app.add_option("--points", points,
                 "of each point in JSON: position,normal,strength,sigma (default position,normal)");
  app.add_flag("--all-edges", all_edges,
               "JSON and CSV: edges that were dropped, too, with the reason");
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
        auto writer = ResultWriter::create({common.output, write, points, all_edges, common.quiet},
                                           common.input_files(source, {config.file}));
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
        console.set_results(writer->place());
        Detection detection;
        return for_each_frame(
            common, source, console, writer->room(), [&](const io::SourceFrame& frame) {
              return step(*detector, frame, detection).and_then([&] {
                detection.index = frame.index;
                detection.stamp_ns = frame.stamp_ns;
                clipping.frame(frame.source, frame.counts, detection.clipped, console);
                console.add_edges(detection.edges.kept);
                Status status = writer->write(detection, frame.counts, frame.source, frame.stem);
                return writer->is_stream() ? console.or_end_run(std::move(status)) : status;
              });
            });
      });
}

}  // namespace thermedge::cli
