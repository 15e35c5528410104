#include "thermedge/io/source.hpp"

#include <algorithm>
#include <utility>

#include "codecs/codecs.hpp"
#include "sources/input_file.hpp"
#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {
namespace {

// Names the frame: by its file, and by its place there where the file holds several.
void label(SourceFrame& frame, const std::string& path, std::string stem, std::int64_t index,
           bool one_of_several) {
  frame.source = path;
  frame.stem = std::move(stem);
  frame.index = index;
  if (one_of_several) {
    std::string digits = std::to_string(index);
    digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
    frame.source += "[" + std::to_string(index) + "]";
    frame.stem += "_" + digits;
  }
}

// One picture file, page by page; it is read into memory at the first one.
class PictureSource final : public FrameSource {
 public:
  PictureSource(std::string path, const Limits& limits) : path_(std::move(path)), limits_(limits) {}

  Result<bool> next(SourceFrame& frame) override {
    if (page_ == pages_) {
      return false;
    }
    Status status = page_ == 0 ? open() : Status();
    if (status) {
      status = decode_picture(bytes_, path_, limits_, page_, frame);
    }
    if (!status) {
      pages_ = ++page_;  // pages after a bad one are not tried
      return tl::unexpected(status.error());
    }
    label(frame, path_, stem_of(path_), static_cast<std::int64_t>(page_), pages_ > 1);
    ++page_;
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override { return std::max<std::size_t>(pages_, 1); }

 private:
  Status open() {
    return read_file(path_, limits_)
        .and_then([&](std::vector<std::byte> bytes) {
          bytes_ = std::move(bytes);
          return count_pages(bytes_, path_, limits_);
        })
        .map([&](std::size_t pages) { pages_ = pages; });
  }

  std::string path_;
  Limits limits_;
  std::vector<std::byte> bytes_;
  std::size_t page_ = 0;
  std::size_t pages_ = 1;
};

// Headerless frames of one size, from a file or standard input, read one at a time.
class RawSource final : public FrameSource {
 public:
  RawSource(const std::string& path, InputFile file, const SourceOptions& options)
      : path_(path),
        stem_(path == "-" ? "stdin" : stem_of(path)),
        file_(std::move(file)),
        options_(options),
        bits_(options.raw_format == RawFormat::kGray8 ? 8 : 16),
        packed_(static_cast<std::size_t>(options.raw_width) *
                static_cast<std::size_t>(options.raw_height) *
                static_cast<std::size_t>(bits_ / 8)) {}

  Result<bool> next(SourceFrame& frame) override {
    if (ended_) {
      return false;
    }
    const auto count = file_.read(packed_);
    ended_ = !count || *count < packed_.size();
    if (!count) {
      return tl::unexpected(count.error());
    }
    if (ended_) {
      return *count == 0 && index_ > 0 ? Result<bool>(false) : left_over(*count);
    }
    frame.bits = bits_;
    frame.counts.resize(options_.raw_width, options_.raw_height);
    unpack_samples(
        packed_, bits_,
        options_.raw_format == RawFormat::kGray16Be ? ByteOrder::kBig : ByteOrder::kLittle, frame);
    label(frame, path_, stem_, index_++, file_.size_bytes() != packed_.size());
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override {
    const auto size = file_.size_bytes();
    return size ? std::max<std::size_t>(*size / packed_.size(), 1) : 0;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> left_over(std::size_t count) const {
    const std::string frames =
        " of " + std::to_string(packed_.size()) + " bytes (" + std::to_string(options_.raw_width) +
        "x" + std::to_string(options_.raw_height) + ", " + std::to_string(bits_) + " bits)";
    if (count == 0) {
      return failure(ErrorCode::kBadData,
                     file_.name() + ": empty; there should be frames" + frames);
    }
    return failure(ErrorCode::kBadData, file_.name() + ": " + std::to_string(count) +
                                            " bytes are left over after " + std::to_string(index_) +
                                            " frames" + frames +
                                            "; do --raw-size and --raw-format fit?");
  }

  std::string path_;
  std::string stem_;
  InputFile file_;
  SourceOptions options_;
  int bits_;
  std::vector<std::byte> packed_;
  std::int64_t index_ = 0;
  bool ended_ = false;
};

Result<std::unique_ptr<FrameSource>> open_raw(const std::string& path,
                                              const SourceOptions& options) {
  if (options.raw_width <= 0 || options.raw_height <= 0) {
    return failure(ErrorCode::kInvalidArgument,
                   path + ": frames without a header; say how large they are: --raw-size WxH");
  }
  if (Status status =
          check_limits(options.limits, path, static_cast<std::uint64_t>(options.raw_width),
                       static_cast<std::uint64_t>(options.raw_height), sizeof(std::uint16_t));
      !status) {
    return tl::unexpected(status.error());
  }
  return InputFile::open(path).map([&](InputFile file) -> std::unique_ptr<FrameSource> {
    return std::make_unique<RawSource>(path, std::move(file), options);
  });
}

Result<std::unique_ptr<FrameSource>> open_file(const std::string& path,
                                               const SourceOptions& options) {
  if (path == "-" || has_raw_ending(path)) {
    return open_raw(path, options);
  }
  return std::make_unique<PictureSource>(path, options.limits);
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

}  // namespace

Result<std::unique_ptr<FrameSource>> open_files(const std::vector<std::string>& inputs,
                                                const SourceOptions& options) {
  return catch_bad_alloc("input", [&]() -> Result<std::unique_ptr<FrameSource>> {
    std::vector<std::string> paths;
    for (const std::string& input : inputs) {
      auto expanded = expand_input(input);
      if (!expanded) {
        return tl::unexpected(expanded.error());
      }
      paths.insert(paths.end(), expanded->begin(), expanded->end());
    }
    return std::make_unique<FileList>(std::move(paths), options);
  });
}

}  // namespace thermedge::io
