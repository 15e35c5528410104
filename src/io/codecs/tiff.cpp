// The pages of a TIFF.
#include <tiffio.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "codecs/picture_reader.hpp"
#include "codecs/samples.hpp"
#include "codecs/tiff_directory.hpp"
#include "codecs/tiff_pages.hpp"

namespace thermedge::io {
namespace {

using Link = TiffPageChain::Link;

// ImageJ writes one directory for a whole stack: the pictures follow each other from where the
// first strip begins.
struct ImageJStack {
  std::uint64_t images = 0;  // as the description says
  std::uint64_t data_at = 0;
  int width = 0, height = 0;
  SampleFormat samples;
  ByteOrder order = ByteOrder::kBig;
  bool is_inverted = false;
  bool is_readable = false;  // the samples lie as they are

  [[nodiscard]] std::uint64_t page_bytes() const {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * samples.bytes();
  }
};

// N of a line "images=N".
std::uint64_t number_of_images(std::string_view description) {
  constexpr std::string_view kKey = "images=";
  if (!description.starts_with("ImageJ=")) {
    return 0;
  }
  const std::size_t at = description.find(std::string("\n") + std::string(kKey));
  if (at == std::string_view::npos) {
    return 0;
  }
  const std::string_view rest = description.substr(at + 1 + kKey.size());
  std::uint64_t images = 0;
  std::from_chars(rest.data(), rest.data() + rest.size(), images);
  return images;
}

std::optional<ImageJStack> find_stack(const TiffPageChain& chain, std::uint64_t directory) {
  const auto tag = [&](std::uint16_t name, std::uint64_t otherwise) {
    return chain.first_number(directory, name).value_or(otherwise);
  };
  ImageJStack stack;
  stack.images = number_of_images(chain.text(directory, TIFFTAG_IMAGEDESCRIPTION));
  if (stack.images < 2) {
    return std::nullopt;
  }
  const std::uint64_t width = tag(TIFFTAG_IMAGEWIDTH, 0);
  const std::uint64_t height = tag(TIFFTAG_IMAGELENGTH, 0);
  const std::uint64_t bits = tag(TIFFTAG_BITSPERSAMPLE, 1);
  const std::uint64_t kind = tag(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const std::uint64_t photometric = tag(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  const auto data_at = chain.first_number(directory, TIFFTAG_STRIPOFFSETS);
  const auto format = sample_format(kind, bits);
  stack.is_readable = data_at && format && width <= INT32_MAX && height <= INT32_MAX &&
                      tag(TIFFTAG_SAMPLESPERPIXEL, 1) == 1 &&
                      tag(TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_NONE &&
                      photometric <= PHOTOMETRIC_MINISBLACK;
  if (stack.is_readable) {
    stack.data_at = *data_at;
    stack.width = static_cast<int>(width);
    stack.height = static_cast<int>(height);
    stack.samples = *format;
    stack.order = chain.byte_order();
    stack.is_inverted = photometric == PHOTOMETRIC_MINISWHITE;
  }
  return stack;
}

class TiffReader final : public PictureReader {
 public:
  explicit TiffReader(const EncodedFile& file) : PictureReader(file), chain_(file.bytes) {
    // A directory of a picture takes more than this; empty ones would take memory only.
    constexpr std::size_t kLeastBytes = 64;
    const std::size_t most_pages = file.bytes.size() / kLeastBytes + 1;
    Link link = chain_.next();
    for (; link == Link::kPage && directories_.size() < most_pages; link = chain_.next()) {
      directories_.push_back(chain_.offset());
    }
    if (link == Link::kPage) {
      directories_.clear();
      fault_ = "it has more pages than it has room for";
    } else if (link == Link::kOutside) {
      fault_ = "page " + std::to_string(directories_.size()) + " lies past the end of the file";
    } else if (link == Link::kCircle) {
      directories_.clear();
      fault_ = "its pages follow each other in a circle";
    } else if (directories_.empty()) {
      fault_ = "it has no pages";
    } else if (directories_.size() == 1) {
      take_stack();
    }
    find_copies();
  }

  [[nodiscard]] bool is_empty() const { return directories_.empty(); }
  [[nodiscard]] const std::string& fault() const { return fault_; }

  [[nodiscard]] std::size_t pages() const override {
    return good_pages() + (fault_.empty() ? 0 : 1);
  }
  [[nodiscard]] PageKind kind(std::size_t page) const override {
    if (page >= good_pages()) {
      return PageKind::kFault;
    }
    return !stack_ && is_copy_[page] ? PageKind::kPassedOver : PageKind::kFrame;
  }
  Status read(std::size_t page, const std::string& name, SourceFrame& frame) override {
    if (page >= good_pages()) {
      return damaged(file(name), "TIFF", fault_);
    }
    return stack_
               ? read_of_stack(page, file(name), frame)
               : decode_tiff_directory(file(name), directories_[page], chain_.byte_order(), frame);
  }
  [[nodiscard]] std::string note() const override {
    const auto copies = std::count(is_copy_.begin(), is_copy_.end(), true);
    if (copies == 0) {
      return "";
    }
    std::string list;
    for (std::size_t page = 0; page < is_copy_.size(); ++page) {
      list += is_copy_[page] ? (list.empty() ? "" : ", ") + std::to_string(page) : "";
    }
    return (copies == 1 ? "page " + list + " is a reduced-resolution copy or a mask and is"
                        : "pages " + list + " are reduced-resolution copies or masks and are") +
           std::string(" passed over");
  }

 private:
  [[nodiscard]] std::size_t good_pages() const {
    return stack_ ? stack_pages_ : directories_.size();
  }

  // The pictures of the stack that the file has room for.
  void take_stack() {
    const auto stack = find_stack(chain_, directories_[0]);
    if (!stack) {
      return;
    }
    if (!stack->is_readable) {
      fault_ = "of the " + std::to_string(stack->images) +
               " images that ImageJ counts only the first can be read, because the stack is "
               "compressed or has several channels";
      return;
    }
    const std::uint64_t size = file().bytes.size();
    const std::uint64_t room = stack->data_at < size && stack->page_bytes() > 0
                                   ? (size - stack->data_at) / stack->page_bytes()
                                   : 0;
    if (room == 0) {
      return;  // reading the one directory tells what is wrong
    }
    stack_ = *stack;
    stack_pages_ = static_cast<std::size_t>(std::min(stack->images, room));
    if (stack->images > room) {
      fault_ = "the file ends early: it holds " + std::to_string(room) + " of the " +
               std::to_string(stack->images) + " images that ImageJ counts";
    }
  }

  // Where all pages say that they are copies, the first is taken for the frame.
  void find_copies() {
    constexpr std::uint64_t kCopy = FILETYPE_REDUCEDIMAGE | FILETYPE_MASK;
    constexpr std::uint64_t kOldCopy = 2;
    for (const std::uint64_t directory : directories_) {
      const auto type = chain_.first_number(directory, TIFFTAG_SUBFILETYPE);
      const auto old_type = chain_.first_number(directory, TIFFTAG_OSUBFILETYPE);
      is_copy_.push_back((type.value_or(0) & kCopy) != 0 || old_type == kOldCopy);
    }
    if (!is_copy_.empty() && std::count(is_copy_.begin(), is_copy_.end(), false) == 0) {
      is_copy_[0] = false;
    }
  }

  Status read_of_stack(std::size_t page, const EncodedFile& named, SourceFrame& frame) const {
    const ImageJStack& s = *stack_;
    return check_claim(named, static_cast<std::uint64_t>(s.width),
                       static_cast<std::uint64_t>(s.height), s.samples.frame_bytes())
        .and_then([&] {
          const Bytes packed =
              named.bytes.subspan(s.data_at + page * s.page_bytes(), s.page_bytes());
          return store_packed(named, packed, s.samples, chosen_order(named.order, s.order), s.width,
                              s.height, frame, s.is_inverted);
        });
  }

  TiffPageChain chain_;
  std::vector<std::uint64_t> directories_;
  std::vector<bool> is_copy_;  // of each directory
  std::optional<ImageJStack> stack_;
  std::size_t stack_pages_ = 0;
  std::string fault_;  // what follows the good pages; empty: nothing
};

}  // namespace

OpenedPicture open_tiff(const EncodedFile& file) {
  auto reader = std::make_unique<TiffReader>(file);
  if (reader->is_empty()) {
    return damaged(file, "TIFF", reader->fault());
  }
  return reader;
}

}  // namespace thermedge::io
