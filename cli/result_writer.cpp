#include "result_writer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include "picture_kinds.hpp"
#include "standard_output.hpp"
#include "thermedge/figures/explained_overlay.hpp"
#include "thermedge/io/overlay.hpp"

namespace thermedge::cli {
namespace {

struct Kind {
  std::string_view name;
  std::string_view ending;
};
constexpr std::array kKinds = {Kind{"mask", ".png"},    Kind{"strength", ".png"},
                               Kind{"labels", ".png"},  Kind{"json", ".json"},
                               Kind{"csv", ".csv"},     Kind{"svg", ".svg"},
                               Kind{"overlay", ".png"}, Kind{"distance", ".png"}};

const Kind* find_kind(std::string_view name) {
  const auto* found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) { return k.name == name; });
  return found == kKinds.end() ? nullptr : found;
}

constexpr std::array<std::string_view, 5> kFileEndings = {".png", ".json", ".jsonl", ".csv",
                                                          ".svg"};

bool is_of_many_frames(const std::string& ending) { return ending == ".jsonl" || ending == ".csv"; }

// The kind of result that `-o x.ENDING` asks for.
std::string kind_of_file(const std::string& ending) {
  return ending == ".png" ? "mask" : ending == ".jsonl" ? "json" : ending.substr(1);
}

Status check_kinds(const std::vector<std::string>& kinds) {
  for (const std::string& kind : kinds) {
    if (find_kind(kind) == nullptr) {
      return failure(ErrorCode::kInvalidArgument,
                     fmt::format("--write {}: should be of mask, strength, labels, json, csv, "
                                 "svg, overlay, distance",
                                 kind));
    }
  }
  return {};
}

// What --points and --all-edges ask for. The position of a point is always written.
Result<io::EdgesFileOptions> edges_options(const ResultRequest& request) {
  io::EdgesFileOptions options;
  options.dropped_edges = request.all_edges;
  if (!request.points) {
    return options;
  }
  options.normals = false;
  for (const std::string& word : split_list(*request.points)) {
    if (word == "normal") {
      options.normals = true;
    } else if (word == "strength") {
      options.strengths = true;
    } else if (word == "sigma") {
      options.position_sigmas = true;
    } else if (word != "position") {
      return failure(
          ErrorCode::kInvalidArgument,
          fmt::format("--points {}: should be of position, normal, strength, sigma", word));
    }
  }
  return options;
}

// An option that changes nothing is a mistake.
Status check_use(const ResultRequest& request, bool is_json_lines,
                 const std::vector<std::string>& kinds) {
  const auto writes = [&](std::string_view kind) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  };
  const bool writes_json = is_json_lines || writes("json");
  if (request.points && !writes_json) {
    return failure(ErrorCode::kInvalidArgument,
                   "--points: is for JSON: -o -, -o x.json, -o x.jsonl or --write json");
  }
  if (request.all_edges && !writes_json && !writes("csv")) {
    return failure(ErrorCode::kInvalidArgument,
                   "--all-edges: is for JSON and CSV: -o -, -o x.json, -o x.jsonl, -o x.csv or "
                   "--write json,csv");
  }
  return {};
}

std::string summary(const Detection& detection, const std::string& source) {
  std::size_t edgels = 0;
  for (const Edge& edge : detection.edges.kept_edges()) {
    edgels += edge.edgels.count;
  }
  return fmt::format("{}: {}x{}, sigma {:.2f} counts, {} of {} edges kept, {} edgels, {:.1f} ms",
                     source, detection.width, detection.height, detection.sigma_counts,
                     detection.edges.kept, detection.edges.edges.size(), edgels,
                     total_ms(detection.times));
}

}  // namespace

ResultWriter::ResultWriter(Mode mode, std::string output, std::vector<std::string> kinds,
                           const InputFiles& inputs)
    : mode_(mode),
      output_(std::move(output)),
      kinds_(std::move(kinds)),
      directory_(output_, inputs),
      stream_(output_) {}

Result<ResultWriter> ResultWriter::create(const ResultRequest& request, const InputFiles& inputs) {
  std::vector<std::string> kinds = split_list(request.kinds);
  if (const Status status = check_kinds(kinds); !status) {
    return tl::unexpected(status.error());
  }
  const auto edges = edges_options(request);
  if (!edges) {
    return tl::unexpected(edges.error());
  }
  return parse_output(request.output, kFileEndings)
      .and_then([&](const OutputTarget& target) {
        return create_in(target, request, std::move(kinds), inputs);
      })
      .and_then([&](ResultWriter writer) -> Result<ResultWriter> {
        if (Status status = check_use(request, writer.mode_ == Mode::kJsonLines, writer.kinds_);
            !status) {
          return tl::unexpected(status.error());
        }
        writer.edges_ = *edges;
        return writer;
      });
}

Result<ResultWriter> ResultWriter::create_in(const OutputTarget& target,
                                             const ResultRequest& request,
                                             std::vector<std::string> kinds,
                                             const InputFiles& inputs) {
  const std::string& output = request.output;
  if (target.kind != OutputKind::kDirectory && !kinds.empty()) {
    return failure(ErrorCode::kInvalidArgument,
                   target.kind == OutputKind::kFile
                       ? fmt::format("-o {}: --write needs a directory: -o DIR", output)
                       : "--write needs a directory: -o DIR");
  }
  switch (target.kind) {
    case OutputKind::kNone:
      return ResultWriter(request.quiet ? Mode::kSilent : Mode::kSummary, output, {}, inputs);
    case OutputKind::kStandardOutput:
      return ResultWriter(Mode::kJsonLines, output, {}, inputs);
    case OutputKind::kFile:
      return inputs.check_file("-o", output).map([&] {
        const Mode mode = is_of_many_frames(target.ending) ? Mode::kStream : Mode::kOneFile;
        return ResultWriter(mode, output, {kind_of_file(target.ending)}, inputs);
      });
    case OutputKind::kDirectory:
      break;
  }
  if (kinds.empty()) {
    kinds = {"mask"};
  }
  return inputs.check_directories("-o", output, kinds).map([&] {
    return ResultWriter(Mode::kDirectory, output, kinds, inputs);
  });
}

std::string ResultWriter::place() const {
  if (mode_ != Mode::kDirectory) {
    return output_.empty() || output_ == "-" ? "standard output" : output_;
  }
  std::string folders;
  for (const std::string& kind : kinds_) {
    folders += (folders.empty() ? "" : ", ") + (std::filesystem::path(output_) / kind).string();
  }
  return folders;
}

Status ResultWriter::write_to_stream(const Detection& detection, const std::string& source) {
  if (kinds_.front() != "csv") {
    return stream_.write(io::edges_to_json(detection, source, edges_));
  }
  const std::string_view header = stream_begun_ ? "" : io::edges_csv_header();
  stream_begun_ = true;
  return stream_.write(std::string(header) + io::edges_to_csv_rows(detection, edges_));
}

Status ResultWriter::write(const Detection& detection, ImageView<const std::uint16_t> counts,
                           const std::string& source, const std::string& stem) {
  switch (mode_) {
    case Mode::kSilent:
      return {};
    case Mode::kSummary:
      print(summary(detection, source) + "\n");
      return {};
    case Mode::kJsonLines:
      print(io::edges_to_json(detection, source, edges_));
      return {};
    case Mode::kStream:
      return write_to_stream(detection, source);
    case Mode::kOneFile:
      return write_kind(kinds_.front(), output_, detection, counts, source);
    case Mode::kDirectory:
      break;
  }
  directory_.begin_frame(stem);
  for (const std::string& kind : kinds_) {
    Status status = directory_.path(kind, std::string(find_kind(kind)->ending))
                        .and_then([&](const std::string& path) {
                          return write_kind(kind, path, detection, counts, source);
                        });
    if (!status) {
      return status;
    }
  }
  return {};
}

Status ResultWriter::write_kind(const std::string& kind, const std::string& path,
                                const Detection& detection, ImageView<const std::uint16_t> counts,
                                const std::string& source) {
  const int width = detection.width;
  const int height = detection.height;
  if (kind == "json") {
    return io::write_file(path, io::edges_to_json(detection, source, edges_));
  }
  if (kind == "csv") {
    return io::write_file(
        path, std::string(io::edges_csv_header()) + io::edges_to_csv_rows(detection, edges_));
  }
  if (kind == "svg") {
    return io::write_file(path, io::edges_to_svg(detection, source));
  }
  if (kind == "overlay" && explain_) {
    return figures::draw_explained_overlay(detection, counts).write(path);
  }
  if (kind == "overlay") {
    io::draw_overlay(detection, counts, colour_);
    return io::write_picture(path, ImageView<const io::Rgb>(colour_.view()));
  }
  if (kind == "mask" || kind == "strength") {
    grey8_.resize(width, height);
    kind == "mask" ? draw_mask(detection.edges, grey8_) : draw_strength(detection.edges, grey8_);
    return io::write_picture(path, ImageView<const std::uint8_t>(grey8_.view()));
  }
  if (kind == "labels") {
    grey16_.resize(width, height);
    draw_labels(detection.edges, grey16_);
  } else {
    distance_transform_.run(detection.edges, width, height, kMaxDistancePx, distance_);
    draw_distance(distance_, grey16_);
  }
  return io::write_picture(path, ImageView<const std::uint16_t>(grey16_.view()));
}

}  // namespace thermedge::cli
