#include "thermedge/io/source.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "codecs/file_format.hpp"
#include "sources/file_sources.hpp"
#include "sources/input_file.hpp"
#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {
namespace {

// A file without a known ending or content is taken for raw frames where their size is given.
Result<bool> is_raw(const std::string& path, const SourceOptions& options) {
  if (path == "-" || has_raw_ending(path)) {
    return true;
  }
  if (options.raw_width <= 0) {
    return false;
  }
  return first_bytes_of(path).map(
      [](const std::vector<std::byte>& bytes) { return format_of(bytes) == FileFormat::kUnknown; });
}

Result<std::unique_ptr<FrameSource>> open_file(const std::string& path,
                                               const SourceOptions& options) {
  const auto raw = is_raw(path, options);
  if (!raw) {
    return tl::unexpected(raw.error());
  }
  return *raw ? open_raw_source(path, options) : make_picture_source(path, options);
}

// One file after the other; a file is opened when its turn comes.
class FileList final : public FrameSource {
 public:
  FileList(std::vector<std::string> paths, const SourceOptions& options)
      : paths_(std::move(paths)), options_(options) {}

  Result<bool> next(SourceFrame& frame) override {
    while (current_ != nullptr || position_ < paths_.size()) {
      const std::string& path = paths_[current_ != nullptr ? position_ - 1 : position_];
      auto more = catch_bad_alloc(path, [&] { return next_of_current(frame); });
      if (!more || *more) {
        return more;
      }
    }
    return false;
  }

  [[nodiscard]] std::size_t size_hint() const override {
    const std::size_t here = current_ != nullptr ? current_->size_hint() : 0;
    const bool known = current_ == nullptr || here > 0;
    return known ? done_ + here + (paths_.size() - position_) : 0;
  }

 private:
  // false: the file has no more frames and is closed.
  Result<bool> next_of_current(SourceFrame& frame) {
    if (current_ == nullptr) {
      auto opened = open_file(paths_[position_++], options_);
      if (!opened) {
        ++done_;
        return tl::unexpected(opened.error());
      }
      current_ = std::move(*opened);
    }
    auto more = current_->next(frame);
    if (more && !*more) {
      done_ += current_->size_hint();
      current_.reset();
    }
    return more;
  }

  std::vector<std::string> paths_;
  SourceOptions options_;
  std::size_t position_ = 0;  // of the file to open next
  std::size_t done_ = 0;      // frames of closed files, bad ones counted as one
  std::unique_ptr<FrameSource> current_;
};

template <class T>
void crop_image(const Rectangle& part, Image<T>& image, Image<T>& scratch) {
  if (image.empty()) {
    return;
  }
  scratch.resize(part.width, part.height);
  copy_pixels(ImageView<const T>(image.view().crop(part.x, part.y, part.width, part.height)),
              scratch.view());
  image.swap(scratch);
}

class CroppedSource final : public FrameSource {
 public:
  CroppedSource(std::unique_ptr<FrameSource> frames, const Crop& crop)
      : frames_(std::move(frames)), crop_(crop) {}

  Result<bool> next(SourceFrame& frame) override {
    auto more = frames_->next(frame);
    if (!more || !*more) {
      return more;
    }
    const auto part = crop_.within(frame.width(), frame.height());
    if (!part) {
      return failure(part.error().code, frame.source + ": " + part.error().message);
    }
    crop_image(*part, frame.counts, counts_);
    crop_image(*part, frame.values, values_);
    crop_image(*part, frame.valid, valid_);
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override { return frames_->size_hint(); }

 private:
  std::unique_ptr<FrameSource> frames_;
  Crop crop_;
  Image<std::uint16_t> counts_;  // scratch memory
  Image<float> values_;
  Image<std::uint8_t> valid_;
};

}  // namespace

std::unique_ptr<FrameSource> crop_frames(std::unique_ptr<FrameSource> frames, const Crop& crop) {
  if (crop.part == Crop::Part::kAll) {
    return frames;
  }
  return std::make_unique<CroppedSource>(std::move(frames), crop);
}

Result<std::unique_ptr<FrameSource>> open_files(const std::vector<std::string>& inputs,
                                                const SourceOptions& options) {
  return catch_bad_alloc("input", [&]() -> Result<std::unique_ptr<FrameSource>> {
    std::vector<std::string> paths;
    for (const std::string& input : inputs) {
      auto expanded = expand_input(input, options.raw_width > 0);
      if (!expanded) {
        return tl::unexpected(expanded.error());
      }
      paths.insert(paths.end(), expanded->begin(), expanded->end());
    }
    return crop_frames(std::make_unique<FileList>(std::move(paths), options), options.crop);
  });
}

}  // namespace thermedge::io
