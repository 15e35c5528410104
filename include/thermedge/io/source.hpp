// Where frames come from: picture files, directories, globs, raw streams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "thermedge/frame.hpp"
#include "thermedge/image.hpp"
#include "thermedge/limits.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// One frame as read. 8-bit pictures are widened, not scaled.
struct SourceFrame {
  Image<std::uint16_t> counts;
  int bits = 16;       // 8 or 16: of a pixel in the file
  std::string source;  // the file as the user named it; "x.tif[7]" where it holds several frames
  std::string stem;    // name for results: "x"; "x_0007" where the file holds several
  std::int64_t index = 0;  // 0, 1, 2 ... within the file
  // As Frame::valid; no file holds it, so sources leave it as it is: empty, or what was set here.
  Image<std::uint8_t> valid;

  // As the detector takes it; valid as long as this lives and is not read into again.
  [[nodiscard]] Frame frame() const {
    Frame frame(counts, bits);
    frame.index = index;
    frame.valid = valid;
    return frame;
  }
};

enum class RawFormat { kGray16Le, kGray16Be, kGray8 };

struct SourceOptions {
  Limits limits;
  int raw_width = 0;  // size of frames in .raw files and on standard input, px; 0: not given
  int raw_height = 0;
  RawFormat raw_format = RawFormat::kGray16Le;
};

// A sequence of frames. One caller at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  // Reads the next frame into `frame` (its memory is reused). true: a frame; false: the end. After
  // an error, the next call goes on after the bad file.
  [[nodiscard]] virtual Result<bool> next(SourceFrame& frame) = 0;
  // Number of files or frames there will be, as far as known; 0: not known.
  [[nodiscard]] virtual std::size_t size_hint() const = 0;
};

// Opens files, directories (every picture in it, natural order: 2 before 10; hidden files, other
// files and directories inside are passed over), globs (also when the shell did not expand them)
// and
// "-" (raw frames on standard input), in the order given. One file is in memory at a time.
// The kind of a file is found by its content: PNG (grey, or colour without colour), TIFF 8/16 bit
// grey (uncompressed, LZW, deflate, PackBits; multi-page), PGM 8/16 bit, NPY (uint8, uint16; 2-D,
// or 3-D as a stack). Files named .raw, and "-", are headerless and need raw_width and raw_height.
// Errors: nothing matches an input. A file that cannot be read is an error of next().
[[nodiscard]] Result<std::unique_ptr<FrameSource>> open_files(
    const std::vector<std::string>& inputs, const SourceOptions& options);

// Decodes a picture in memory; `name` is for messages. `page`: 0-based, of a TIFF or a stack; it is
// an error where there is no such page. On error, the frame's pixels are unspecified. Thread-safe.
[[nodiscard]] Status decode_picture(std::span<const std::byte> bytes, const std::string& name,
                                    const Limits& limits, std::size_t page, SourceFrame& frame);

// Number of pages of a picture in memory: 1 but for multi-page TIFF and 3-D NPY. A TIFF that was
// cut off counts one page more than it has; decoding that one says so.
[[nodiscard]] Result<std::size_t> count_pages(std::span<const std::byte> bytes,
                                              const std::string& name, const Limits& limits);

// The first page of one picture file.
[[nodiscard]] Result<SourceFrame> read_picture(const std::string& path, const Limits& limits = {});

}  // namespace thermedge::io
