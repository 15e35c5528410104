// For libFuzzer: any bytes are a picture or an error. Build with
//   clang++ -std=c++20 -fsanitize=fuzzer,address,undefined -Iinclude fuzz/decode_fuzz.cpp
//     and the library built with the same sanitizers.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "thermedge/io/source.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace thermedge;
  const auto bytes = std::as_bytes(std::span(data, size));
  const Limits limits{.max_side_px = 4096, .max_bytes = 1 << 24};
  const auto pages = io::count_pages(bytes, "fuzz", limits);
  constexpr std::size_t kMostPages = 10;
  io::SourceFrame frame;
  for (std::size_t page = 0; page < std::min(pages.value_or(1), kMostPages); ++page) {
    if (!io::decode_picture(bytes, "fuzz", limits, page, frame)) {
      break;
    }
  }
  return 0;
}
