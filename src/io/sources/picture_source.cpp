#include <algorithm>
#include <utility>
#include <vector>

#include "codecs/picture_reader.hpp"
#include "sources/file_sources.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {
namespace {

class PictureSource final : public FrameSource {
 public:
  PictureSource(std::string path, const SourceOptions& options)
      : path_(std::move(path)), options_(options) {}

  Result<bool> next(SourceFrame& frame) override {
    if (!is_open_) {
      is_open_ = true;
      if (Status status = open(); !status) {
        return tl::unexpected(status.error());
      }
    }
    while (page_ < pages_ && reader_->kind(page_) == PageKind::kPassedOver) {
      ++page_;
    }
    if (page_ >= pages_) {
      return false;
    }
    const std::size_t page = page_++;
    const Status status = reader_->read(page, page_name(page), frame);
    failures_ = status ? 0 : failures_ + 1;
    if (!status) {
      return give_up_after_many(status.error());
    }
    label_frame(frame, path_, stem_of(path_), static_cast<std::int64_t>(page), frames_ > 1);
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override { return std::max<std::size_t>(frames_, 1); }

 private:
  Status open() {
    auto bytes = read_file(path_, options_.limits);
    if (!bytes) {
      return tl::unexpected(bytes.error());
    }
    bytes_ = std::move(*bytes);
    auto reader = open_picture({bytes_, path_, options_.limits, options_.byte_order});
    if (!reader) {
      return tl::unexpected(reader.error());
    }
    reader_ = std::move(*reader);
    pages_ = reader_->pages();
    for (std::size_t page = 0; page < pages_; ++page) {
      frames_ += reader_->kind(page) == PageKind::kFrame ? 1 : 0;
    }
    if (const std::string note = reader_->note(); !note.empty() && options_.note) {
      options_.note(path_ + ": " + note);
    }
    return {};
  }

  [[nodiscard]] std::string page_name(std::size_t page) const {
    const bool is_one_of_several = frames_ > 1 && reader_->kind(page) == PageKind::kFrame;
    return is_one_of_several ? path_ + "[" + std::to_string(page) + "]" : path_;
  }

  // Of a file whose pages are all of a kind that is not read, the first few are enough to name.
  tl::unexpected<Error> give_up_after_many(Error error) {
    constexpr std::size_t kMostInARow = 16;
    if (failures_ >= kMostInARow && page_ < pages_) {
      error.message += "; so were the " + std::to_string(failures_ - 1) +
                       " pages before it, and pages " + std::to_string(page_) + " to " +
                       std::to_string(pages_ - 1) + " are not tried";
      page_ = pages_;
    }
    return tl::unexpected(std::move(error));
  }

  std::string path_;
  SourceOptions options_;
  std::vector<std::byte> bytes_;
  std::unique_ptr<PictureReader> reader_;
  bool is_open_ = false;
  std::size_t pages_ = 0;
  std::size_t frames_ = 0;
  std::size_t page_ = 0;      // to be read next
  std::size_t failures_ = 0;  // in a row
};

}  // namespace

void label_frame(SourceFrame& frame, const std::string& path, std::string stem, std::int64_t index,
                 bool is_one_of_several) {
  frame.source = path;
  frame.stem = std::move(stem);
  frame.index = index;
  if (is_one_of_several) {
    std::string digits = std::to_string(index);
    digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
    frame.source += "[" + std::to_string(index) + "]";
    frame.stem += "_" + digits;
  }
}

std::unique_ptr<FrameSource> make_picture_source(const std::string& path,
                                                 const SourceOptions& options) {
  return std::make_unique<PictureSource>(path, options);
}

}  // namespace thermedge::io
