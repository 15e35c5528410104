#include <algorithm>
#include <utility>
#include <vector>

#include "codecs/samples.hpp"
#include "sources/file_sources.hpp"
#include "sources/input_file.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {
namespace {

struct RawSamples {
  SampleFormat format;
  ByteOrder order = ByteOrder::kLittle;
};

RawSamples samples_of(RawFormat format) {
  switch (format) {
    case RawFormat::kGray8:
      return {{SampleKind::kUnsigned, 8}, ByteOrder::kLittle};
    case RawFormat::kGray16Be:
      return {{SampleKind::kUnsigned, 16}, ByteOrder::kBig};
    case RawFormat::kGrayF32Le:
      return {{SampleKind::kFloat, 32}, ByteOrder::kLittle};
    case RawFormat::kGrayF32Be:
      return {{SampleKind::kFloat, 32}, ByteOrder::kBig};
    case RawFormat::kGray16Le:
      break;
  }
  return {{SampleKind::kUnsigned, 16}, ByteOrder::kLittle};
}

class RawSource final : public FrameSource {
 public:
  RawSource(const std::string& path, InputFile file, const SourceOptions& options)
      : path_(path),
        stem_(path == "-" ? "stdin" : stem_of(path)),
        file_(std::move(file)),
        options_(options),
        samples_(samples_of(options.raw_format)),
        frame_header_bytes_(static_cast<std::size_t>(options.raw_frame_header_bytes)),
        packed_(frame_header_bytes_ + static_cast<std::size_t>(options.raw_width) *
                                          static_cast<std::size_t>(options.raw_height) *
                                          samples_.format.bytes()) {}

  Result<bool> next(SourceFrame& frame) override {
    if (ended_) {
      return false;
    }
    if (Status status = skip_header(); !status) {
      ended_ = true;
      return tl::unexpected(status.error());
    }
    const auto count = file_.read(packed_);
    ended_ = !count || *count < packed_.size();
    if (!count) {
      return tl::unexpected(count.error());
    }
    if (ended_) {
      return *count == 0 && index_ > 0 ? Result<bool>(false) : left_over_bytes(*count);
    }
    const EncodedFile encoded{packed_, file_.name(), options_.limits};
    return store_packed(encoded, encoded.bytes.subspan(frame_header_bytes_), samples_.format,
                        chosen_order(options_.byte_order, samples_.order), options_.raw_width,
                        options_.raw_height, frame)
        .map([&] {
          label_frame(frame, path_, stem_, index_++, !is_single());
          return true;
        });
  }

  [[nodiscard]] std::size_t size_hint() const override {
    const auto size = file_.size_bytes();
    const std::uint64_t header = std::min(options_.raw_header_bytes, size.value_or(0));
    return size ? std::max<std::size_t>((*size - header) / packed_.size(), 1) : 0;
  }

 private:
  // Once, in front of the first frame.
  Status skip_header() {
    std::vector<std::byte> skipped(std::min<std::uint64_t>(options_.raw_header_bytes, 1U << 16U));
    while (header_done_ < options_.raw_header_bytes) {
      const std::span<std::byte> piece = std::span(skipped).first(static_cast<std::size_t>(
          std::min<std::uint64_t>(options_.raw_header_bytes - header_done_, skipped.size())));
      const auto count = file_.read(piece);
      if (!count) {
        return tl::unexpected(count.error());
      }
      header_done_ += *count;
      if (*count < piece.size()) {
        return failure(ErrorCode::kBadData, file_.name() + ": ends after " +
                                                std::to_string(header_done_) +
                                                " bytes, within the header of --raw-header " +
                                                std::to_string(options_.raw_header_bytes));
      }
    }
    return {};
  }

  [[nodiscard]] bool is_single() const {
    return file_.size_bytes() == options_.raw_header_bytes + packed_.size();
  }

  [[nodiscard]] tl::unexpected<Error> left_over_bytes(std::size_t count) const {
    const std::string header =
        frame_header_bytes_ > 0 ? " and a header of " + std::to_string(frame_header_bytes_) : "";
    const std::string frames = " of " + std::to_string(packed_.size()) + " bytes (" +
                               std::to_string(options_.raw_width) + "x" +
                               std::to_string(options_.raw_height) + ", " +
                               std::to_string(samples_.format.bits) + " bits" + header + ")";
    if (count == 0) {
      return failure(ErrorCode::kBadData,
                     file_.name() + ": empty; there should be frames" + frames);
    }
    return failure(ErrorCode::kBadData,
                   file_.name() + ": " + std::to_string(count) +
                       (count == 1 ? " byte is" : " bytes are") + " left over after " +
                       std::to_string(index_) + (index_ == 1 ? " frame" : " frames") + frames +
                       "; do --raw-size and --raw-format fit, and is there a header "
                       "(--raw-header, --raw-frame-header)?");
  }

  std::string path_;
  std::string stem_;
  InputFile file_;
  SourceOptions options_;
  RawSamples samples_;
  std::size_t frame_header_bytes_;
  std::vector<std::byte> packed_;  // a frame with its header
  std::uint64_t header_done_ = 0;  // bytes of the file's header that were passed over
  std::int64_t index_ = 0;
  bool ended_ = false;
};

Status check_sizes(const std::string& path, const SourceOptions& options) {
  if (options.raw_width <= 0 || options.raw_height <= 0) {
    return failure(ErrorCode::kInvalidArgument,
                   path + ": frames without a header; say how large they are: --raw-size WxH");
  }
  if (options.raw_frame_header_bytes > options.limits.max_bytes) {
    return failure(ErrorCode::kInvalidArgument,
                   path + ": a header of " + std::to_string(options.raw_frame_header_bytes) +
                       " bytes in front of each frame is more than the limit of " +
                       std::to_string(options.limits.max_bytes));
  }
  return check_limits(options.limits, path, static_cast<std::uint64_t>(options.raw_width),
                      static_cast<std::uint64_t>(options.raw_height),
                      samples_of(options.raw_format).format.frame_bytes());
}

}  // namespace

Result<std::unique_ptr<FrameSource>> open_raw_source(const std::string& path,
                                                     const SourceOptions& options) {
  return check_sizes(path, options)
      .and_then([&] { return InputFile::open(path); })
      .map([&](InputFile file) -> std::unique_ptr<FrameSource> {
        return std::make_unique<RawSource>(path, std::move(file), options);
      });
}

}  // namespace thermedge::io
