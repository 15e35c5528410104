#include "thermedge/eval/files.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <filesystem>
#include <functional>
#include <system_error>

#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/io/files.hpp"
#include "thermedge/io/source.hpp"
#include "truth_maps.hpp"

namespace thermedge::eval {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<std::string>;

bool is_directory(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}
bool is_file(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// The visible files in a directory for whose name `wanted` holds, in natural order.
Result<Paths> list_files(const std::string& directory,
                         const std::function<bool(const std::string&)>& wanted) {
  Paths paths;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with('.') && wanted(name) && is_file(entry->path().string())) {
      paths.push_back(entry->path().string());
    }
  }
  if (error) {
    return failure(ErrorCode::kIo, directory + ": cannot be listed: " + error.message());
  }
  std::sort(paths.begin(), paths.end(), io::natural_less);
  return paths;
}

Result<Paths> list_ending(const std::string& directory, const std::string& ending) {
  return list_files(directory, [&](const std::string& name) { return name.ends_with(ending); });
}

Result<std::string> read_text(const std::string& path, const Limits& limits) {
  return io::read_file(path, limits).map([](const std::vector<std::byte>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
}

Result<CurveFrame> read_curves(const std::string& path, const Limits& limits) {
  return read_text(path, limits).and_then([&](const std::string& text) {
    return parse_curves(text, path);
  });
}

Prediction drawn(CurveFrame curves) {
  Prediction edges;
  draw_curves(curves, 0, edges.map);
  edges.curves = std::move(curves);
  return edges;
}

// Highest value that is no edge: of a picture of 0 and one other value, and of one of 1 alone, 0;
// else the middle of the scale.
int highest_of_none(ImageView<const std::uint8_t> picture) {
  constexpr int kMiddle = 127;
  std::bitset<256> values;
  for (int y = 0; y < picture.height(); ++y) {
    std::for_each(picture.row(y), picture.row(y) + picture.width(),
                  [&](std::uint8_t value) { values.set(value); });
  }
  const bool two = values.count() == 2 && values[0];
  const bool ones = values.count() == 1 && values[1];
  return two || ones ? 0 : kMiddle;
}

// A map of curves as annotators draw it: one pixel wide.
Image<std::uint8_t> thin_map(const CurveFrame& curves, double least_contrast_counts) {
  Image<std::uint8_t> drawing;
  draw_curves(curves, least_contrast_counts, drawing);
  Image<std::uint8_t> map;
  thin_at(drawing.view(), 1, map);
  return map;
}

}  // namespace

Result<JsonLines> JsonLines::read(const std::string& path, const Limits& limits) {
  return read_text(path, limits).and_then([&](std::string text) -> Result<JsonLines> {
    JsonLines lines;
    lines.path_ = path;
    lines.text_ = std::move(text);
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < lines.text_.size();) {
      const std::size_t end = std::min(lines.text_.find('\n', begin), lines.text_.size());
      ++number;
      if (lines.text_.find_first_not_of(" \t\r", begin) < end) {
        lines.lines_.push_back({number, begin, end - begin});
      }
      begin = end + 1;
    }
    if (lines.lines_.empty()) {
      return failure(ErrorCode::kBadData, path + ": should hold a JSON object on each line");
    }
    return lines;
  });
}

std::string JsonLines::label(std::size_t index) const {
  return path_ + ":" + std::to_string(lines_[index].number);
}

Result<CurveFrame> JsonLines::frame(std::size_t index) const {
  return parse_curves(text(index), label(index));
}

Result<Image<std::uint8_t>> read_edge_map(const std::string& path, const Limits& limits) {
  return io::read_picture(path, limits)
      .and_then([&](const io::SourceFrame& frame) -> Result<Image<std::uint8_t>> {
        if (frame.bits != 8) {
          return failure(ErrorCode::kUnsupported,
                         path + ": 16 bits a pixel; edge maps have 8 (255: strongest, 0: none)");
        }
        Image<std::uint8_t> map(frame.counts.width(), frame.counts.height());
        copy_pixels(frame.counts.view(), map.view());
        return map;
      });
}

Result<PredictionSet> PredictionSet::open(const std::string& path, const Limits& limits) {
  PredictionSet set;
  set.limits_ = limits;
  if (path.ends_with(".jsonl")) {
    auto lines = JsonLines::read(path, limits);
    if (!lines) {
      return tl::unexpected(lines.error());
    }
    for (std::size_t i = 0; i < lines->size(); ++i) {
      set.names_.push_back(std::to_string(i));
    }
    set.lines_ = std::move(*lines);
    set.curves_ = true;
    return set;
  }
  if (is_directory(path)) {
    auto pictures = list_ending(path, ".png");
    auto results = pictures ? list_ending(path, ".json") : pictures;
    if (!results) {
      return tl::unexpected(results.error());
    }
    if (!pictures->empty() && !results->empty()) {
      return failure(ErrorCode::kBadData,
                     path + ": holds PNG and JSON files; name a directory that holds one kind");
    }
    set.curves_ = pictures->empty();
    set.paths_ = std::move(set.curves_ ? *results : *pictures);
    if (set.paths_.empty()) {
      return failure(ErrorCode::kIo, path + ": no edge maps (PNG) or results (JSON) in it");
    }
  } else if (is_file(path)) {
    set.curves_ = path.ends_with(".json");
    set.paths_ = {path};
  } else {
    return failure(ErrorCode::kIo, path + ": no such file or directory");
  }
  std::transform(set.paths_.begin(), set.paths_.end(), std::back_inserter(set.names_), io::stem_of);
  return set;
}

Result<Prediction> PredictionSet::read(std::size_t index) const {
  const std::string& label = lines_ ? names_[index] : paths_[index];
  return io::catch_bad_alloc(label, [&]() -> Result<Prediction> {
    if (!curves_) {
      return read_edge_map(paths_[index], limits_).map([](Image<std::uint8_t> map) {
        return Prediction{std::move(map), std::nullopt};
      });
    }
    return (lines_ ? lines_->frame(index) : read_curves(paths_[index], limits_)).map(drawn);
  });
}

Result<GroundTruthSet> GroundTruthSet::open(const std::string& path, const Options& options) {
  GroundTruthSet set;
  set.path_ = path;
  set.options_ = options;
  set.directory_ = is_directory(path);
  if (!set.directory_ && !is_file(path)) {
    return failure(ErrorCode::kIo, path + ": no such file or directory");
  }
  std::string lines = set.directory_ || !path.ends_with(".jsonl") ? "" : path;
  if (set.directory_) {
    const auto found = list_ending(path, ".jsonl");
    if (!found) {
      return tl::unexpected(found.error());
    }
    lines = found->size() == 1 ? found->front() : "";
  }
  if (!lines.empty()) {
    auto read = JsonLines::read(lines, options.limits);
    if (!read) {
      return tl::unexpected(read.error());
    }
    set.path_ = lines;
    set.lines_ = std::move(*read);
  }
  return set;
}

Status GroundTruthSet::check_frames(std::size_t count) const {
  const std::size_t there = lines_ ? lines_->size() : directory_ ? count : 1;
  if (there == count) {
    return {};
  }
  return failure(ErrorCode::kBadData, path_ + ": truth of " + std::to_string(there) +
                                          " frames, but there are results of " +
                                          std::to_string(count));
}

Result<TrueEdges> GroundTruthSet::from_curves(Result<CurveFrame> curves) const {
  return std::move(curves).map([&](CurveFrame frame) {
    TrueEdges edges;
    edges.maps.annotators.push_back(thin_map(frame, options_.least_contrast_counts));
    if (options_.least_contrast_counts > 0) {
      edges.maps.accepted.push_back(thin_map(frame, 0));
    }
    edges.curves = std::move(frame);
    return edges;
  });
}

Result<TrueEdges> GroundTruthSet::read_file(const std::string& path) const {
  const std::string ending = io::ending_of(path);
  const auto with_maps = [](TruthMaps maps) { return TrueEdges{std::move(maps), std::nullopt}; };
  if (ending == ".npz") {
    return read_npz_truth(path, options_.limits).map(with_maps);
  }
  if (ending == ".mat") {
    return read_mat_truth(path, options_.limits).map(with_maps);
  }
  if (ending == ".json" || ending == ".jsonl") {
    return from_curves(read_curves(path, options_.limits));
  }
  return read_edge_map(path, options_.limits).map([&](const Image<std::uint8_t>& picture) {
    TruthMaps maps;
    maps.annotators.push_back(map_above(picture.view(), highest_of_none(picture.view())));
    return with_maps(std::move(maps));
  });
}

Result<TrueEdges> GroundTruthSet::read(const std::string& name, std::size_t index) const {
  return io::catch_bad_alloc(path_, [&]() -> Result<TrueEdges> {
    if (lines_) {
      return from_curves(lines_->frame(index));
    }
    if (!directory_) {
      return read_file(path_);
    }
    const std::string base = (fs::path(path_) / name).string();
    for (const char* ending : {".npz", ".mat", ".png"}) {
      if (is_file(base + ending)) {
        return read_file(base + ending);
      }
    }
    auto pictures = list_files(path_, [&](const std::string& file) {
      return file.starts_with(name + "_") && file.ends_with(".png");
    });
    if (pictures && pictures->empty() && is_directory(base)) {
      pictures = list_ending(base, ".png");
    }
    TruthMaps maps;
    for (const std::string& path : pictures.value_or(Paths{})) {
      auto one = read_file(path);
      if (!one) {
        return one;
      }
      maps.annotators.push_back(std::move(one->maps.annotators.front()));
    }
    if (!maps.annotators.empty()) {
      return checked_maps(std::move(maps), base, "edge maps").map([](TruthMaps checked) {
        return TrueEdges{std::move(checked), std::nullopt};
      });
    }
    for (const char* ending : {".json", ".jsonl"}) {
      if (is_file(base + ending)) {
        return read_file(base + ending);
      }
    }
    return failure(ErrorCode::kIo, base + ": no truth there (.npz, .mat, .png, _*.png, .json)");
  });
}

}  // namespace thermedge::eval
