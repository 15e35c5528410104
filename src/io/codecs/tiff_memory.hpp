// libtiff on bytes in memory, its messages caught.
#pragma once

#include <tiffio.h>

#include <memory>

#include "codecs/codecs.hpp"

namespace thermedge::io {

// The memory that libtiff reads from or writes to, and the first error that it reported.
struct TiffMemory {
  Bytes input;
  std::string output;
  std::uint64_t at = 0;
  char error[160] = "";
};

struct TiffCloser {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffFile = std::unique_ptr<TIFF, TiffCloser>;

// `mode` is that of TIFFOpen. libtiff may take up to `max_bytes` at a time; 0: no bound. Null where
// it cannot be opened.
[[nodiscard]] TiffFile open_tiff(TiffMemory& memory, const char* mode, std::uint64_t max_bytes);

}  // namespace thermedge::io
