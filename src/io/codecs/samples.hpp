// Samples as files hold them, and the frame that they become.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "codecs/codecs.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::io {

inline constexpr ByteOrder kNativeOrder =
    std::endian::native == std::endian::big ? ByteOrder::kBig : ByteOrder::kLittle;

[[nodiscard]] constexpr ByteOrder other_order(ByteOrder order) {
  return order == ByteOrder::kBig ? ByteOrder::kLittle : ByteOrder::kBig;
}
// The order to read by, where the format says `order`.
[[nodiscard]] ByteOrder chosen_order(SampleOrder choice, ByteOrder order);

enum class SampleKind : std::uint8_t { kUnsigned, kSigned, kFloat };

// 8, 16, 32 or 64 bits; floats of 16, 32 or 64.
struct SampleFormat {
  SampleKind kind = SampleKind::kUnsigned;
  int bits = 8;

  [[nodiscard]] bool are_counts() const { return kind == SampleKind::kUnsigned && bits <= 16; }
  [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(bits) / 8; }
  // What a pixel takes in memory at most, for Limits.
  [[nodiscard]] std::size_t frame_bytes() const { return are_counts() ? 2 : 8; }
};

// Fills a frame with samples, in any order of its pixels. Unsigned samples of 8 and 16 bits are
// counts. Of other whole numbers the frame is one of counts where all lie within 0..65535, else one
// of floats.
class SampleStore {
 public:
  // Gives the frame its size and forgets what was known of the one before. `is_inverted`: the
  // largest count stands for the darkest pixel; of counts only.
  SampleStore(SampleFormat format, ByteOrder order, int width, int height, bool is_inverted,
              SourceFrame& frame);

  // The next `count` pixels of row `y` from column `x` on, `step` bytes apart.
  void put(int x, int y, const std::byte* samples, std::size_t count, std::size_t step);

  // After the last sample. Fails where whole numbers are too large for a float to hold them.
  [[nodiscard]] Status finish(const EncodedFile& file);

 private:
  template <class T>
  void put_counts(std::uint16_t* row, const std::byte* samples, std::size_t count,
                  std::size_t step);
  template <class T>
  void put_values(float* row, const std::byte* samples, std::size_t count, std::size_t step);
  void turn_into_counts();

  SampleFormat format_;
  bool is_swapped_;
  bool is_inverted_;
  SourceFrame& frame_;
  double least_ = 0, greatest_ = 0;  // of whole numbers
};

// The same for all pixels at once, that lie packed row by row.
[[nodiscard]] Status store_packed(const EncodedFile& file, Bytes packed, SampleFormat format,
                                  ByteOrder order, int width, int height, SourceFrame& frame,
                                  bool is_inverted = false);

// After counts and values are filled: notes the pixels that are no numbers, and the counts that
// stand for the values.
void finish_values(SourceFrame& frame);

}  // namespace thermedge::io
