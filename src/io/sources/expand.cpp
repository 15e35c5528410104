// Directories and globs as lists of files.
#include <glob.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

#include "codecs/file_format.hpp"
#include "codecs/flir_records.hpp"
#include "sources/input_file.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<std::string>;

// Endings of frames without a header, which are read where their size is given.
constexpr std::array<std::string_view, 6> kRawEndings = {".raw", ".bin", ".dat",
                                                         ".y16", ".img", ".gray"};

// A plain JPEG beside the frames is no frame; FLIR's are.
bool is_picture(const fs::path& path, bool with_raw) {
  const std::string name = path.string();
  if (has_picture_ending(name) || (with_raw && std::find(kRawEndings.begin(), kRawEndings.end(),
                                                         ending_of(name)) != kRawEndings.end())) {
    return true;
  }
  const auto bytes = first_bytes_of(name);
  const FileFormat format = bytes ? format_of(*bytes) : FileFormat::kUnknown;
  return format == FileFormat::kJpeg ? has_flir(*bytes) : format != FileFormat::kUnknown;
}

Result<Paths> pictures_in(const std::string& directory, bool with_raw) {
  Paths paths;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool hidden = entry->path().filename().string().starts_with('.');
    std::error_code unreadable;
    if (!hidden && entry->is_regular_file(unreadable) && is_picture(entry->path(), with_raw)) {
      paths.push_back(entry->path().string());
    }
  }
  if (error) {
    return failure(ErrorCode::kIo, directory + ": cannot be listed: " + error.message());
  }
  std::sort(paths.begin(), paths.end(), natural_less);
  return paths;
}

Result<Paths> list_directory(const std::string& directory, bool with_raw) {
  return pictures_in(directory, with_raw).and_then([&](Paths paths) -> Result<Paths> {
    if (paths.empty()) {
      return failure(ErrorCode::kIo,
                     directory +
                         ": no pictures in this directory (PNG, TIFF, PGM, NPY, FLIR JPEG, FFF and "
                         "SEQ, .raw; with --raw-size .bin and .dat, too)");
    }
    return paths;
  });
}

Result<Paths> match_glob(const std::string& pattern, bool with_raw) {
  glob_t found{};
  const std::unique_ptr<glob_t, void (*)(glob_t*)> freed(&found, globfree);
  const int code = ::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found);
  if (code == GLOB_NOSPACE) {
    return failure(ErrorCode::kOutOfMemory, pattern + ": out of memory");
  }
  Paths matches(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  std::sort(matches.begin(), matches.end(), natural_less);
  Paths paths;
  for (std::string& match : matches) {
    std::error_code error;
    if (!fs::is_directory(match, error)) {
      paths.push_back(std::move(match));
    } else if (auto pictures = pictures_in(match, with_raw)) {
      paths.insert(paths.end(), pictures->begin(), pictures->end());
    } else {
      return pictures;
    }
  }
  if (paths.empty()) {
    return failure(ErrorCode::kIo, pattern + ": no file matches");
  }
  return paths;
}

// Takes the number at `at` and gives its digits without leading zeros.
std::string_view take_digits(std::string_view text, std::size_t& at) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
  const std::size_t first = std::min(text.find_first_not_of('0', at), end);
  at = end;
  return text.substr(first, end - first);
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view x = take_digits(a, i);
      const std::string_view y = take_digits(b, j);
      if (x != y) {
        return x.size() != y.size() ? x.size() < y.size() : x < y;
      }
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  const bool a_ended = i == a.size();
  const bool b_ended = j == b.size();
  // Names that differ in leading zeros only still need an order.
  return a_ended != b_ended ? a_ended : a < b;
}

Result<std::vector<std::string>> expand_input(const std::string& input, bool with_raw) {
  if (input == "-") {
    return Paths{input};
  }
  std::error_code error;
  const fs::file_status status = fs::status(input, error);
  if (fs::is_directory(status)) {
    return list_directory(input, with_raw);
  }
  if (status.type() != fs::file_type::not_found) {
    return Paths{input};
  }
  if (input.find_first_of("*?[") != std::string::npos) {
    return match_glob(input, with_raw);
  }
  return failure(ErrorCode::kIo, input + ": no such file or directory");
}

}  // namespace thermedge::io
