// The interface that all decoders have: a file in memory, and the pages in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "codecs/codecs.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// What a page is: a frame, even where reading it fails; a repetition of another page, such as a
// thumbnail, which is passed over; or not even a page, so that reading it tells what is wrong with
// the file.
enum class PageKind : std::uint8_t { kFrame, kPassedOver, kFault };

// One opened file. Its bytes and limits must outlive it. One caller at a time.
class PictureReader {
 public:
  virtual ~PictureReader() = default;

  // Pages in the file, one at least; reading one may still fail.
  [[nodiscard]] virtual std::size_t pages() const { return 1; }
  [[nodiscard]] virtual PageKind kind(std::size_t /*page*/) const { return PageKind::kFrame; }
  // Fills counts, values, bits and what else the file knows of a page below pages(). `name` is for
  // messages.
  [[nodiscard]] virtual Status read(std::size_t page, const std::string& name,
                                    SourceFrame& frame) = 0;
  // What was passed over within the file, as the end of a line that begins with its name; empty
  // where nothing was.
  [[nodiscard]] virtual std::string note() const { return ""; }

 protected:
  explicit PictureReader(const EncodedFile& file) : file_(file) {}
  [[nodiscard]] EncodedFile file(const std::string& name) const {
    return {file_.bytes, name, file_.limits, file_.order};
  }
  [[nodiscard]] const EncodedFile& file() const { return file_; }

 private:
  EncodedFile file_;
};

// Pictures one after the other, each found by what `Picture` holds, and what is wrong with the rest
// of the file where anything is.
template <class Picture>
class PicturesReader : public PictureReader {
 public:
  [[nodiscard]] std::size_t pages() const override { return pictures_.size() + (fault_ ? 1 : 0); }
  [[nodiscard]] PageKind kind(std::size_t page) const override {
    return page < pictures_.size() ? PageKind::kFrame : PageKind::kFault;
  }
  Status read(std::size_t page, const std::string& name, SourceFrame& frame) override {
    if (page >= pictures_.size()) {
      return failure(fault_->code, name + fault_->message.substr(file().name.size()));
    }
    return read_picture(pictures_[page], file(name), frame);
  }

 protected:
  PicturesReader(const EncodedFile& file, const Picture& first)
      : PictureReader(file), pictures_{first} {}
  virtual Status read_picture(const Picture& picture, const EncodedFile& named,
                              SourceFrame& frame) const = 0;

  std::vector<Picture> pictures_;
  std::optional<Error> fault_;  // of what follows the last good picture
};

using OpenedPicture = Result<std::unique_ptr<PictureReader>>;

// One for each format; they read no more than they need to know the pages.
[[nodiscard]] OpenedPicture open_png(const EncodedFile& file);
[[nodiscard]] OpenedPicture open_pgm(const EncodedFile& file);
[[nodiscard]] OpenedPicture open_tiff(const EncodedFile& file);
[[nodiscard]] OpenedPicture open_npy(const EncodedFile& file);
[[nodiscard]] OpenedPicture open_fff(const EncodedFile& file);
[[nodiscard]] OpenedPicture open_jpeg(const EncodedFile& file);

// The one for the content of the file.
[[nodiscard]] OpenedPicture open_picture(const EncodedFile& file);

}  // namespace thermedge::io
