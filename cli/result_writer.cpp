#include "result_writer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include "thermedge/figures/explained_overlay.hpp"
#include "thermedge/io/overlay.hpp"

namespace thermedge::cli {
namespace {

struct Kind {
  std::string_view name;
  std::string_view ending;
};
constexpr std::array kKinds = {
    Kind{"mask", ".png"}, Kind{"strength", ".png"}, Kind{"labels", ".png"},  Kind{"json", ".json"},
    Kind{"svg", ".svg"},  Kind{"overlay", ".png"},  Kind{"distance", ".png"}};

// The distance picture holds 1/256 px in 16 bits, so it reaches 255 px.
constexpr float kDistanceUnitsPerPx = 256;
constexpr float kMaxDistancePx = 255;

const Kind* find_kind(std::string_view name) {
  const auto* found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) { return k.name == name; });
  return found == kKinds.end() ? nullptr : found;
}

constexpr std::array<std::string_view, 3> kFileEndings = {".png", ".json", ".svg"};

// The kind of result that `-o x.ENDING` asks for.
std::string kind_of_file(const std::string& ending) {
  return ending == ".png" ? "mask" : ending.substr(1);
}

Status check_kinds(const std::vector<std::string>& kinds) {
  for (const std::string& kind : kinds) {
    if (find_kind(kind) == nullptr) {
      return failure(ErrorCode::kInvalidArgument,
                     fmt::format("--write {}: should be of mask, strength, labels, json, svg, "
                                 "overlay, distance",
                                 kind));
    }
  }
  return {};
}

// Results of a directory lie in folders of it, one for each kind.
Status check_directories(const std::string& output, const std::vector<std::string>& kinds,
                         const InputFiles& inputs) {
  Status status = inputs.check_directory("-o", output);
  for (const std::string& kind : kinds) {
    status = status.and_then([&] {
      return inputs.check_directory("-o", (std::filesystem::path(output) / kind).string());
    });
  }
  return status;
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
      directory_(output_, inputs) {}

Result<ResultWriter> ResultWriter::create(const std::string& output, const std::string& kinds,
                                          const InputFiles& inputs) {
  std::vector<std::string> list = split_list(kinds);
  if (const Status status = check_kinds(list); !status) {
    return tl::unexpected(status.error());
  }
  const auto target = parse_output(output, kFileEndings);
  if (!target) {
    return tl::unexpected(target.error());
  }
  switch (target->kind) {
    case OutputKind::kNone:
    case OutputKind::kStandardOutput:
      if (!list.empty()) {
        return failure(ErrorCode::kInvalidArgument, "--write needs a directory: -o DIR");
      }
      return ResultWriter(target->kind == OutputKind::kNone ? Mode::kSummary : Mode::kJsonLines,
                          output, {}, inputs);
    case OutputKind::kFile:
      if (!list.empty()) {
        return failure(ErrorCode::kInvalidArgument,
                       fmt::format("-o {}: --write needs a directory: -o DIR", output));
      }
      return inputs.check_file("-o", output).map([&] {
        return ResultWriter(Mode::kOneFile, output, {kind_of_file(target->ending)}, inputs);
      });
    case OutputKind::kDirectory:
      break;
  }
  if (list.empty()) {
    list = {"mask"};
  }
  return check_directories(output, list, inputs).map([&] {
    return ResultWriter(Mode::kDirectory, output, list, inputs);
  });
}

Status ResultWriter::write(const Detection& detection, ImageView<const std::uint16_t> counts,
                           const std::string& source, const std::string& stem) {
  switch (mode_) {
    case Mode::kSummary:
      fmt::print("{}\n", summary(detection, source));
      return {};
    case Mode::kJsonLines:
      fmt::print("{}", io::edges_to_json(detection, source));
      return {};
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
    return io::write_file(path, io::edges_to_json(detection, source));
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
  grey16_.resize(width, height);
  if (kind == "labels") {
    draw_labels(detection.edges, grey16_);
  } else {
    distance_transform_.run(detection.edges, width, height, kMaxDistancePx, distance_);
    for (int y = 0; y < height; ++y) {
      const float* distance = distance_.distance_px.row(y);
      std::transform(distance, distance + width, grey16_.row(y), [](float px) {
        return static_cast<std::uint16_t>(std::lround(px * kDistanceUnitsPerPx));
      });
    }
  }
  return io::write_picture(path, ImageView<const std::uint16_t>(grey16_.view()));
}

}  // namespace thermedge::cli
