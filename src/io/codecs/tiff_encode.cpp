#include <algorithm>
#include <vector>

#include "codecs/codecs.hpp"
#include "codecs/tiff_memory.hpp"

namespace thermedge::io {

Result<std::string> encode_tiff(const Samples& samples, const std::string& name) {
  TiffMemory memory;
  constexpr std::uint64_t kNoBound = 0;
  TiffFile tiff = open_tiff(memory, "w", kNoBound);
  bool good = tiff != nullptr;
  if (good) {
    TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, samples.width);
    TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, samples.height);
    TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, samples.bits);
    TIFFSetField(tiff.get(), TIFFTAG_SAMPLEFORMAT,
                 samples.bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, samples.channels);
    TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR,
                 samples.bits == 32 ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
    TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff.get(), 0));
    std::vector<std::byte> line(samples.packed_row_bytes());
    for (int y = 0; y < samples.height && good; ++y) {
      // A copy, because the predictor works in place.
      std::copy_n(samples.row(y), line.size(), line.begin());
      good = TIFFWriteScanline(tiff.get(), line.data(), static_cast<std::uint32_t>(y)) == 1;
    }
    good = good && TIFFFlush(tiff.get()) == 1;
  }
  tiff.reset();
  if (!good || memory.error[0] != '\0') {
    return failure(ErrorCode::kOutOfMemory, name + ": TIFF cannot be written: " + memory.error);
  }
  return std::move(memory.output);
}

}  // namespace thermedge::io
