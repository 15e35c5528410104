// FLIR files put together byte by byte, by the public description of their records.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "support/encoded_pictures.hpp"

namespace thermedge::test {

// A record that begins with the number 2 in its byte order, filled with zeros.
class FlirRecord {
 public:
  FlirRecord(std::size_t bytes, bool big_endian) : big_endian_(big_endian), text_(bytes, '\0') {
    put(0, 2, 2);
  }
  void put(std::size_t at, std::uint64_t value, int bytes) {
    text_.replace(at, static_cast<std::size_t>(bytes), number(value, bytes, big_endian_));
  }
  void put_float(std::size_t at, float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    put(at, bits, 4);
  }
  void append(const std::string& data) { text_ += data; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

// `data`: samples, or a picture file.
inline std::string flir_raw_record(int width, int height, const std::string& data,
                                   bool big_endian = false) {
  FlirRecord record(32, big_endian);
  record.put(2, static_cast<std::uint64_t>(width), 2);
  record.put(4, static_cast<std::uint64_t>(height), 2);
  record.append(data);
  return record.text();
}

struct FlirCameraValues {
  float emissivity = 1;
  float reflected_k = 293.15F;
  float r1 = 16000, b = 1420, f = 1, r2 = 0.011F;
  std::int32_t o = -5000;
  std::uint32_t seconds = 0, ms = 0;
};

inline std::string flir_camera_record(const FlirCameraValues& values, bool big_endian = false) {
  FlirRecord record(0x390, big_endian);
  record.put_float(0x20, values.emissivity);
  record.put_float(0x28, values.reflected_k);
  record.put_float(0x58, values.r1);
  record.put_float(0x5c, values.b);
  record.put_float(0x60, values.f);
  record.put(0x308, static_cast<std::uint32_t>(values.o), 4);
  record.put_float(0x30c, values.r2);
  record.put(0x384, values.seconds, 4);
  record.put(0x388, values.ms, 4);
  return record.text();
}

// Records with their types, one after the other behind the list of them.
inline std::string fff_file(const std::vector<std::pair<int, std::string>>& records,
                            bool big_endian = false) {
  constexpr std::size_t kHeader = 64;
  constexpr std::size_t kEntry = 32;
  std::string file("FFF\0test", 8);
  file.resize(kHeader, '\0');
  file.replace(0x14, 12,
               number(100, 4, big_endian) + number(kHeader, 4, big_endian) +
                   number(records.size(), 4, big_endian));
  std::size_t offset = kHeader + kEntry * records.size();
  for (const auto& [type, data] : records) {
    std::string entry = number(static_cast<std::uint64_t>(type), 2, big_endian) +
                        number(0, 2, big_endian) + number(100, 4, big_endian) +
                        number(1, 4, big_endian) + number(offset, 4, big_endian) +
                        number(data.size(), 4, big_endian);
    entry.resize(kEntry, '\0');
    file += entry;
    offset += data.size();
  }
  for (const auto& record : records) {
    file += record.second;
  }
  return file;
}

inline constexpr int kFlirRaw = 1;
inline constexpr int kFlirCamera = 0x20;

inline std::string jpeg_segment(char marker, const std::string& data) {
  return std::string("\xff") + marker + number(data.size() + 2, 2, true) + data;
}

// A JPEG with a file in APP1 segments of at most `part_bytes`, without a picture of its own.
inline std::string flir_jpeg(const std::string& fff, std::size_t part_bytes) {
  std::string file("\xff\xd8");
  file += jpeg_segment('\xe0', std::string("JFIF\0\1\1\0\0\1\0\1\0\0", 14));
  const std::size_t parts = (fff.size() + part_bytes - 1) / part_bytes;
  for (std::size_t i = 0; i < parts; ++i) {
    file += jpeg_segment('\xe1', std::string("FLIR\0\1", 6) + static_cast<char>(i) +
                                     static_cast<char>(parts - 1) +
                                     fff.substr(i * part_bytes, part_bytes));
  }
  return file + "\xff\xd9";
}

}  // namespace thermedge::test
