#include "thermedge/io/source.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <utility>

#include "io/codecs.hpp"
#include "io/files.hpp"

namespace thermedge::io {
namespace {

std::string numbered(const std::string& stem, std::int64_t index) {
  std::string digits = std::to_string(index);
  digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
  return stem + "_" + digits;
}

// One picture file, page by page.
class PictureSource final : public FrameSource {
 public:
  PictureSource(std::string path, const Limits& limits) : path_(std::move(path)), limits_(limits) {}

  Result<bool> next(Frame& frame) override {
    if (page_ == 0) {
      if (Status status = open(); !status) {
        page_ = pages_ = 1;
        return tl::unexpected(status.error());
      }
    }
    if (page_ == pages_) {
      bytes_ = {};
      return false;
    }
    if (Status status = decode_picture(bytes_, path_, limits_, page_, frame); !status) {
      page_ = pages_;
      return tl::unexpected(status.error());
    }
    frame.source = path_;
    frame.stem = stem_of(path_);
    frame.index = static_cast<std::int64_t>(page_);
    if (pages_ > 1) {
      frame.source += "[" + std::to_string(page_) + "]";
      frame.stem = numbered(frame.stem, frame.index);
    }
    ++page_;
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override { return 1; }

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
  std::size_t pages_ = 0;
};

// Headerless frames of one size, from a file or standard input, read one at a time.
class RawSource final : public FrameSource {
 public:
  RawSource(std::string name, std::string stem, std::FILE* file, const SourceOptions& options)
      : name_(std::move(name)), stem_(std::move(stem)), file_(file), options_(options) {
    const std::size_t sample_bytes = options.raw_format == RawFormat::kGray8 ? 1 : 2;
    packed_.resize(static_cast<std::size_t>(options.raw_width) *
                   static_cast<std::size_t>(options.raw_height) * sample_bytes);
  }
  RawSource(const RawSource&) = delete;
  RawSource& operator=(const RawSource&) = delete;
  ~RawSource() override {
    if (file_ != stdin) {
      std::fclose(file_);
    }
  }

  Result<bool> next(Frame& frame) override {
    if (ended_) {
      return false;
    }
    const std::size_t count = std::fread(packed_.data(), 1, packed_.size(), file_);
    if (count < packed_.size()) {
      ended_ = true;
      if (std::ferror(file_) != 0) {
        return failure(ErrorCode::kIo, name_ + ": cannot be read: " + std::strerror(errno));
      }
      if (count == 0) {
        return false;
      }
      return failure(ErrorCode::kBadData,
                     name_ + ": " + std::to_string(count) + " bytes are left over after " +
                         std::to_string(index_) + " frames of " + std::to_string(packed_.size()) +
                         " bytes; do --raw-size and --raw-format fit?");
    }
    frame.bits = options_.raw_format == RawFormat::kGray8 ? 8 : 16;
    frame.counts.resize(options_.raw_width, options_.raw_height);
    unpack_samples(packed_, frame.bits, options_.raw_format == RawFormat::kGray16Be, frame);
    frame.source = name_ + "[" + std::to_string(index_) + "]";
    frame.stem = numbered(stem_, index_);
    frame.index = index_++;
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override {
    std::error_code error;
    const auto size = std::filesystem::file_size(name_, error);
    return error ? 0 : static_cast<std::size_t>(size) / packed_.size();
  }

 private:
  std::string name_;
  std::string stem_;
  std::FILE* file_;
  SourceOptions options_;
  std::vector<std::byte> packed_;
  std::int64_t index_ = 0;
  bool ended_ = false;
};

Result<std::unique_ptr<FrameSource>> open_raw(const std::string& name,
                                              const SourceOptions& options) {
  if (options.raw_width <= 0 || options.raw_height <= 0) {
    return failure(ErrorCode::kInvalidArgument,
                   name + ": frames without a header; say how large they are: --raw-size WxH");
  }
  if (Status status =
          check_limits(options.limits, name, static_cast<std::uint64_t>(options.raw_width),
                       static_cast<std::uint64_t>(options.raw_height), 2);
      !status) {
    return tl::unexpected(status.error());
  }
  const bool standard_input = name == "-";
  std::FILE* file = standard_input ? stdin : std::fopen(name.c_str(), "rb");
  if (file == nullptr) {
    return failure(ErrorCode::kIo, name + ": cannot be opened: " + std::strerror(errno));
  }
  return std::unique_ptr<FrameSource>(
      std::make_unique<RawSource>(name, standard_input ? "stdin" : stem_of(name), file, options));
}

Result<std::unique_ptr<FrameSource>> open_file(const std::string& path,
                                               const SourceOptions& options) {
  if (path == "-" || has_raw_ending(path)) {
    return open_raw(path, options);
  }
  return std::unique_ptr<FrameSource>(std::make_unique<PictureSource>(path, options.limits));
}

// One file after the other; a file is opened when its turn comes.
class FileList final : public FrameSource {
 public:
  FileList(std::vector<std::string> paths, SourceOptions options)
      : paths_(std::move(paths)), options_(options) {}

  Result<bool> next(Frame& frame) override {
    while (current_ != nullptr || position_ < paths_.size()) {
      if (current_ == nullptr) {
        auto opened = open_file(paths_[position_++], options_);
        if (!opened) {
          return tl::unexpected(opened.error());
        }
        current_ = std::move(*opened);
      }
      auto more = current_->next(frame);
      if (!more || *more) {
        return more;
      }
      current_.reset();
    }
    return false;
  }

  [[nodiscard]] std::size_t size_hint() const override {
    if (paths_.size() == 1 && current_ != nullptr) {
      return current_->size_hint();
    }
    return paths_.size();
  }

 private:
  std::vector<std::string> paths_;
  SourceOptions options_;
  std::size_t position_ = 0;
  std::unique_ptr<FrameSource> current_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> open_files(const std::vector<std::string>& inputs,
                                                const SourceOptions& options) {
  std::vector<std::string> paths;
  for (const std::string& input : inputs) {
    auto expanded = expand_input(input);
    if (!expanded) {
      return tl::unexpected(expanded.error());
    }
    paths.insert(paths.end(), expanded->begin(), expanded->end());
  }
  return std::unique_ptr<FrameSource>(std::make_unique<FileList>(std::move(paths), options));
}

}  // namespace thermedge::io
