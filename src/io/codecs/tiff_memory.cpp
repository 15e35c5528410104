#include "codecs/tiff_memory.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>

namespace thermedge::io {
namespace {

TiffMemory& memory_of(thandle_t handle) { return *static_cast<TiffMemory*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* out, tmsize_t count) {
  TiffMemory& memory = memory_of(handle);
  const std::size_t size = memory.input.size();
  const std::size_t at = std::min<std::uint64_t>(memory.at, size);
  const std::size_t taken =
      std::min(static_cast<std::size_t>(std::max<tmsize_t>(count, 0)), size - at);
  if (taken > 0) {
    std::memcpy(out, memory.input.data() + at, taken);
    memory.at += taken;
  }
  return static_cast<tmsize_t>(taken);
}

// No exception may pass through libtiff.
tmsize_t write_bytes(thandle_t handle, void* bytes, tmsize_t count) {
  TiffMemory& memory = memory_of(handle);
  const auto length = static_cast<std::size_t>(count);
  try {
    memory.output.resize(std::max<std::size_t>(memory.output.size(), memory.at + length));
  } catch (const std::bad_alloc&) {
    return 0;
  } catch (const std::length_error&) {
    return 0;
  }
  std::memcpy(memory.output.data() + memory.at, bytes, length);
  memory.at += length;
  return count;
}

toff_t size_of(thandle_t handle) {
  const TiffMemory& memory = memory_of(handle);
  return std::max<toff_t>(memory.input.size(), memory.output.size());
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  TiffMemory& memory = memory_of(handle);
  const toff_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? memory.at : size_of(handle);
  memory.at = from + offset;
  return memory.at;
}

int close_nothing(thandle_t) { return 0; }

int on_error(TIFF*, void* user, const char*, const char* format, std::va_list arguments) {
  TiffMemory& memory = memory_of(user);
  if (memory.error[0] == '\0') {
    std::vsnprintf(memory.error, sizeof(memory.error), format, arguments);
  }
  return 1;
}

int on_warning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

}  // namespace

TiffFile open_tiff(TiffMemory& memory, const char* mode, std::uint64_t max_bytes) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  if (options == nullptr) {
    return nullptr;
  }
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(max_bytes));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &memory);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &memory);
  return TiffFile(TIFFClientOpenExt("", mode, &memory, read_bytes, write_bytes, seek, close_nothing,
                                    size_of, nullptr, nullptr, options.get()));
}

}  // namespace thermedge::io
