// FLIR's raw pictures: FFF and SEQ files, and radiometric JPEG.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>

#include "codecs/file_format.hpp"
#include "codecs/flir_records.hpp"
#include "codecs/picture_reader.hpp"
#include "codecs/samples.hpp"

namespace thermedge::io {
namespace {

std::uint16_t swapped(std::uint16_t count) {
  return static_cast<std::uint16_t>(count << 8 | count >> 8);
}

// Sum of steps from pixel to pixel, of the counts as they are and with their bytes swapped.
struct Roughness {
  std::uint64_t as_is = 0;
  std::uint64_t swapped = 0;
};

Roughness roughness(ImageView<const std::uint16_t> counts) {
  Roughness sum;
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 1; x < counts.width(); ++x) {
      const std::uint16_t a = counts(x - 1, y);
      const std::uint16_t b = counts(x, y);
      sum.as_is += static_cast<std::uint64_t>(std::abs(a - b));
      sum.swapped += static_cast<std::uint64_t>(std::abs(swapped(a) - swapped(b)));
    }
  }
  return sum;
}

// Cameras store PNG with little-endian samples, against the format; should one do it right, its
// picture is smoother as it is.
void put_bytes_right(SourceFrame& frame) {
  const Roughness sum = roughness(frame.counts);
  if (sum.as_is >= sum.swapped) {
    for (int y = 0; y < frame.counts.height(); ++y) {
      std::uint16_t* row = frame.counts.row(y);
      std::transform(row, row + frame.counts.width(), row, swapped);
    }
  }
}

// A picture file in the record.
Status read_picture_inside(const EncodedFile& file, FileFormat format, SourceFrame& frame) {
  return open_picture(file)
      .and_then([&](const std::unique_ptr<PictureReader>& reader) {
        return reader->read(0, file.name, frame);
      })
      .and_then([&]() -> Status {
        if (frame.bits != 16 || frame.is_float()) {
          return damaged(file, "FLIR file", "its raw picture has not 16 bits");
        }
        if (format == FileFormat::kPng && file.order == SampleOrder::kAsFormat) {
          put_bytes_right(frame);
        }
        return {};
      });
}

Status read_raw(const EncodedFile& file, const FlirRaw& raw, SourceFrame& frame) {
  const FileFormat format = format_of(raw.data);
  if (format == FileFormat::kPng || format == FileFormat::kTiff) {
    return read_picture_inside({raw.data, file.name, file.limits, file.order}, format, frame);
  }
  if (format == FileFormat::kJpeg) {
    return failure(ErrorCode::kUnsupported,
                   file.name +
                       ": a FLIR recording with compressed pictures (JPEG-LS, as in CSQ); "
                       "SEQ, FFF and JPEG with raw counts are read");
  }
  const SampleFormat samples{SampleKind::kUnsigned, 16};
  return check_claim(file, raw.width, raw.height, samples.bytes()).and_then([&]() -> Status {
    const std::size_t needed = std::size_t{raw.width} * raw.height * samples.bytes();
    if (raw.data.size() < needed) {
      return damaged(file, "FLIR file", "the record of its raw picture ends early");
    }
    return store_packed(file, raw.data.first(needed), samples, chosen_order(file.order, raw.order),
                        static_cast<int>(raw.width), static_cast<int>(raw.height), frame);
  });
}

// FFF after FFF: a single picture, or a sequence.
class FffReader final : public PicturesReader<FlirBlock> {
 public:
  FffReader(const EncodedFile& file, const FlirBlock& first) : PicturesReader(file, first) {
    std::size_t next = next_block(first.end);
    while (!fault_ && next < file.bytes.size()) {
      bytes_between_ += next - pictures_.back().end;
      const auto block = read_flir_block(file, next);
      if (!block) {
        fault_ = block.error();
        break;
      }
      pictures_.push_back(*block);
      next = next_block(block->end);
    }
    if (!fault_) {
      note_left_over();
    }
  }

  [[nodiscard]] std::string note() const override {
    return bytes_between_ > 0
               ? std::to_string(bytes_between_) + " bytes between its pictures are passed over"
               : "";
  }

 private:
  Status read_picture(const FlirBlock& block, const EncodedFile& named,
                      SourceFrame& frame) const override {
    return read_flir_raw(named, block.raw)
        .and_then([&](const FlirRaw& raw) { return read_raw(named, raw, frame); })
        .map([&] {
          const FlirCamera camera = read_flir_camera(block.camera_info);
          frame.counts_model = camera.counts_model;
          frame.stamp_ns = camera.stamp_ns;
        });
  }

  // Zeros fill files up; anything else may be the beginning of a picture that was cut off.
  void note_left_over() {
    const Bytes rest = file().bytes.subspan(pictures_.back().end);
    if (std::any_of(rest.begin(), rest.end(), [](std::byte b) { return b != std::byte{0}; })) {
      fault_ = left_over(file(), rest.size(), "the picture").value();
    }
  }

  // Where the next block begins at or after `at`; the end of the file where there is none.
  [[nodiscard]] std::size_t next_block(std::size_t at) const {
    constexpr std::string_view kMagic("FFF\0", 4);
    const Bytes bytes = file().bytes;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return std::min(text.find(kMagic, at), bytes.size());
  }

  std::size_t bytes_between_ = 0;
};

// The FFF in a JPEG.
class FlirJpegReader final : public PictureReader {
 public:
  FlirJpegReader(const EncodedFile& file, std::vector<std::byte> fff)
      : PictureReader(file), fff_(std::move(fff)) {}

  Status read(std::size_t /*page*/, const std::string& name, SourceFrame& frame) override {
    EncodedFile inside = file(name);
    inside.bytes = fff_;
    return read_flir_block(inside, 0).and_then(
        [&](const FlirBlock& block) { return FffReader(inside, block).read(0, name, frame); });
  }

 private:
  std::vector<std::byte> fff_;
};

}  // namespace

OpenedPicture open_fff(const EncodedFile& file) {
  return read_flir_block(file, 0).map(
      [&](const FlirBlock& first) -> std::unique_ptr<PictureReader> {
        return std::make_unique<FffReader>(file, first);
      });
}

OpenedPicture open_jpeg(const EncodedFile& file) {
  return flir_of_jpeg(file).and_then([&](std::vector<std::byte> fff) -> OpenedPicture {
    if (fff.empty()) {
      return failure(ErrorCode::kUnsupported,
                     file.name +
                         ": a JPEG picture without raw counts; of JPEG only FLIR's radiometric "
                         "pictures are read");
    }
    return std::make_unique<FlirJpegReader>(file, std::move(fff));
  });
}

}  // namespace thermedge::io
