// Where frames come from: picture files, directories, globs, raw streams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "thermedge/float_scale.hpp"
#include "thermedge/frame.hpp"
#include "thermedge/image.hpp"
#include "thermedge/io/crop.hpp"
#include "thermedge/limits.hpp"
#include "thermedge/radiometry/planck.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// One frame as read. 8-bit pictures are widened, not scaled.
struct SourceFrame {
  // Raw counts; of a float frame the nearest counts of its values, by `scale`.
  Image<std::uint16_t> counts;
  // Of a float frame (floating-point numbers, or whole ones that are no 16-bit counts): its pixels
  // in the unit of the file. Empty where `counts` are the pixels themselves.
  Image<float> values;
  FloatScale scale;    // kept from frame to frame as long as it suits
  int bits = 16;       // 8 or 16: of a count
  std::string source;  // the file as the user named it; "x.tif[7]" where it holds several frames
  std::string stem;    // name for results: "x"; "x_0007" where the file holds several
  std::int64_t index = 0;  // the page within the file: 0, 1, 2 ...
  // When it was taken, where the source says so: since 1970 UTC; simulated frames since the first.
  std::optional<std::int64_t> stamp_ns;
  // As Frame::valid: 0 where the file has no number (NaN) or an infinite one; empty where all
  // pixels are measurements.
  Image<std::uint8_t> valid;
  // How counts become degrees, where the file holds the camera's calibration: for the emissivity
  // and the reflected temperature that are stored with it, without the atmosphere in between.
  std::optional<CountsModel> counts_model;

  [[nodiscard]] bool is_float() const { return !values.empty(); }
  [[nodiscard]] int width() const { return counts.width(); }
  [[nodiscard]] int height() const { return counts.height(); }

  // As the detector takes it; valid as long as this lives and is not read into again.
  [[nodiscard]] Frame frame() const {
    Frame frame = is_float() ? Frame(values) : Frame(counts, bits);
    frame.index = index;
    frame.stamp_ns = stamp_ns;
    frame.valid = valid;
    return frame;
  }
};

enum class RawFormat : std::uint8_t { kGray16Le, kGray16Be, kGray8, kGrayF32Le, kGrayF32Be };

// The byte order of samples in files: as the format, or the header of the file, says; little or big
// endian whatever it says; or the other one of what it says.
enum class SampleOrder : std::uint8_t { kAsFormat, kLittle, kBig, kSwapped };

struct SourceOptions {
  Limits limits;
  int raw_width = 0;  // size of frames without a header, px; 0: not given
  int raw_height = 0;
  RawFormat raw_format = RawFormat::kGray16Le;
  std::uint64_t raw_header_bytes = 0;        // passed over at the beginning of a raw file or stream
  std::uint64_t raw_frame_header_bytes = 0;  // passed over in front of each raw frame
  SampleOrder byte_order = SampleOrder::kAsFormat;
  Crop crop;
  // Told what is passed over on purpose, such as thumbnails: one line each. May be empty.
  std::function<void(const std::string&)> note;
};

// A sequence of frames. One caller at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  // Reads the next frame into `frame` (its memory is reused). true: a frame; false: the end. After
  // an error, the next call goes on after the bad page or file.
  [[nodiscard]] virtual Result<bool> next(SourceFrame& frame) = 0;
  // Number of files or frames there will be, as far as known; 0: not known.
  [[nodiscard]] virtual std::size_t size_hint() const = 0;
};

// Opens files, directories (every picture in it, natural order: 2 before 10; hidden files, other
// files and directories inside are passed over), globs (also when the shell did not expand them)
// and
// "-" (raw frames on standard input), in the order given. One file is in memory at a time.
// The kind of a file is found by its content; docs/input.md lists what is read. Files named .raw,
// files of unknown content where raw_width and raw_height are given, and "-" are frames without a
// header. All frames are cropped by options.crop.
// Errors: nothing matches an input. A file or page that cannot be read is an error of next().
[[nodiscard]] Result<std::unique_ptr<FrameSource>> open_files(
    const std::vector<std::string>& inputs, const SourceOptions& options);

// The frames of `frames`, cropped. A frame that the rectangle does not fit is an error of next().
[[nodiscard]] std::unique_ptr<FrameSource> crop_frames(std::unique_ptr<FrameSource> frames,
                                                       const Crop& crop);

// Decodes a picture in memory; `name` is for messages. `page`: 0-based, as in the file; it is an
// error where there is no such page. On error, the frame's pixels are unspecified. Thread-safe.
[[nodiscard]] Status decode_picture(std::span<const std::byte> bytes, const std::string& name,
                                    const Limits& limits, std::size_t page, SourceFrame& frame);

// Number of pages of a picture in memory, of which some may turn out to be unreadable. A TIFF that
// was cut off counts one page more than it has; decoding that one says so.
[[nodiscard]] Result<std::size_t> count_pages(std::span<const std::byte> bytes,
                                              const std::string& name, const Limits& limits);

// The first page of one picture file.
[[nodiscard]] Result<SourceFrame> read_picture(const std::string& path, const Limits& limits = {});

}  // namespace thermedge::io
