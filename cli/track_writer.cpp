#include "track_writer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "picture_kinds.hpp"
#include "standard_output.hpp"

namespace thermedge::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kFileEndings = {".jsonl", ".csv"};
constexpr std::array<std::string_view, 4> kKinds = {"json", "csv", "overlay", "distance"};

Status check_kinds(const std::vector<std::string>& kinds) {
  for (const std::string& kind : kinds) {
    if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
      return failure(ErrorCode::kInvalidArgument,
                     fmt::format("--write {}: should be of json, csv, overlay, distance", kind));
    }
  }
  return {};
}

std::string file_in(const std::string& directory, std::string_view name) {
  return (fs::path(directory) / name).string();
}

std::string summary(const TrackedFrame& frame, const std::string& source) {
  std::size_t edgels = 0;
  for (const TrackRun& run : frame.tracks.runs) {
    edgels += run.edgels.count;
  }
  std::string events;
  for (const auto& event : kFrameEvents) {
    events += frame.events.has(event.value) ? fmt::format(", {}", event.name) : "";
  }
  const Point moved = frame.motion({0, 0});
  return fmt::format(
      "{}: {} edges, {} edgels with an identity, {} identities born, {} ended, motion "
      "{:+.1f} {:+.1f} px{}, {:.1f} ms\n",
      source, frame.detection.edges.kept, edgels, frame.tracks.born.size(),
      frame.tracks.ended.size(), moved.x, moved.y, events, total_ms(frame.detection.times));
}

}  // namespace

TrackWriter::TrackWriter(OutputKind kind, std::string output, std::vector<std::string> kinds,
                         bool quiet, const InputFiles& inputs)
    : kind_(kind),
      output_(std::move(output)),
      kinds_(std::move(kinds)),
      quiet_(quiet),
      directory_(output_, inputs),
      json_(kind_ == OutputKind::kDirectory ? file_in(output_, "tracks.jsonl") : output_),
      csv_(kind_ == OutputKind::kDirectory ? file_in(output_, "tracks.csv") : output_) {}

Result<TrackWriter> TrackWriter::create(const std::string& output, const std::string& kinds,
                                        bool quiet, const InputFiles& inputs) {
  std::vector<std::string> list = split_list(kinds);
  if (const Status status = check_kinds(list); !status) {
    return tl::unexpected(status.error());
  }
  const auto target = parse_output(output, kFileEndings);
  if (!target) {
    return tl::unexpected(target.error());
  }
  if (target->kind != OutputKind::kDirectory && !list.empty()) {
    return failure(ErrorCode::kInvalidArgument, "--write needs a directory: -o DIR");
  }
  if (target->kind == OutputKind::kDirectory) {
    list = list.empty() ? std::vector<std::string>{"json"} : list;
    return inputs.check_directories("-o", output, list).map([&] {
      return TrackWriter(target->kind, output, list, quiet, inputs);
    });
  }
  if (target->kind == OutputKind::kFile) {
    list = {target->ending == ".csv" ? "csv" : "json"};
    return inputs.check_file("-o", output).map([&] {
      return TrackWriter(target->kind, output, list, quiet, inputs);
    });
  }
  return TrackWriter(target->kind, output, {}, quiet, inputs);
}

bool TrackWriter::draws_overlays() const {
  return std::find(kinds_.begin(), kinds_.end(), "overlay") != kinds_.end();
}

std::string TrackWriter::place() const {
  if (kind_ == OutputKind::kNone || kind_ == OutputKind::kStandardOutput) {
    return "standard output";
  }
  return output_;
}

Status TrackWriter::write(const TrackedFrame& frame, ImageView<const std::uint16_t> counts,
                          const std::string& source, const std::string& stem) {
  if (kind_ == OutputKind::kStandardOutput) {
    print(io::tracks_to_json(frame, source));
    return {};
  }
  if (kind_ == OutputKind::kNone) {
    if (!quiet_) {
      print(summary(frame, source));
    }
    return {};
  }
  directory_.begin_frame(stem);
  Status status;
  for (const std::string& kind : kinds_) {
    status = status.and_then([&] { return write_kind(kind, frame, counts, source); });
  }
  return status;
}

Status TrackWriter::write_kind(const std::string& kind, const TrackedFrame& frame,
                               ImageView<const std::uint16_t> counts, const std::string& source) {
  if (kind == "json") {
    return json_.write(io::tracks_to_json(frame, source));
  }
  if (kind == "csv") {
    const std::string_view header = csv_begun_ ? "" : io::tracks_csv_header();
    csv_begun_ = true;
    return csv_.write(std::string(header) + io::tracks_to_csv_rows(frame));
  }
  const auto path = directory_.path(kind, ".png");
  if (!path) {
    return tl::unexpected(path.error());
  }
  if (kind == "overlay") {
    io::draw_tracks(frame, counts, colour_);
    return io::write_picture(*path, ImageView<const io::Rgb>(colour_.view()));
  }
  const Detection& detection = frame.detection;
  distance_transform_.run(detection.edges, detection.width, detection.height, kMaxDistancePx,
                          distance_);
  draw_distance(distance_, grey16_);
  return io::write_picture(*path, ImageView<const std::uint16_t>(grey16_.view()));
}

}  // namespace thermedge::cli
