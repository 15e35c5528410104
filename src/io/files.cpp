#include "io/files.hpp"

#include <glob.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "io/kinds.hpp"

namespace thermedge::io {
namespace {

namespace fs = std::filesystem;

std::string lower_ending(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_picture(const fs::path& path) {
  if (has_picture_ending(path.string())) {
    return true;
  }
  std::array<char, 16> first{};
  std::ifstream file(path, std::ios::binary);
  file.read(first.data(), first.size());
  const auto count = static_cast<std::size_t>(file.gcount());
  return kind_of(std::as_bytes(std::span(first.data(), count))) != Kind::kUnknown;
}

void sort_naturally(std::vector<std::string>& paths) {
  std::sort(paths.begin(), paths.end(), natural_less);
}

Result<std::vector<std::string>> list_directory(const std::string& directory) {
  std::vector<std::string> paths;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool hidden = entry->path().filename().string().starts_with('.');
    std::error_code unreadable;
    if (!hidden && entry->is_regular_file(unreadable) && is_picture(entry->path())) {
      paths.push_back(entry->path().string());
    }
  }
  if (error) {
    return failure(ErrorCode::kIo, directory + ": cannot be listed: " + error.message());
  }
  if (paths.empty()) {
    return failure(ErrorCode::kIo, directory +
                                       ": no pictures in this directory (PNG, TIFF, PGM, "
                                       "NPY, .raw)");
  }
  sort_naturally(paths);
  return paths;
}

Result<std::vector<std::string>> match_glob(const std::string& pattern) {
  glob_t matches{};
  const std::unique_ptr<glob_t, void (*)(glob_t*)> freed(&matches, globfree);
  if (glob(pattern.c_str(), GLOB_NOSORT, nullptr, &matches) != 0) {
    return failure(ErrorCode::kIo, pattern + ": no file matches");
  }
  std::vector<std::string> paths(matches.gl_pathv, matches.gl_pathv + matches.gl_pathc);
  sort_naturally(paths);
  return paths;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path, const Limits& limits) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) {
    return failure(ErrorCode::kIo, path + ": no such file or directory");
  }
  if (!fs::is_regular_file(status)) {
    return failure(ErrorCode::kUnsupported, path + ": neither a file nor a directory");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) {
    return failure(ErrorCode::kIo, path + ": cannot be opened: " + std::strerror(errno));
  }
  if (size > limits.max_bytes) {
    return failure(ErrorCode::kLimitExceeded, path + ": " + std::to_string(size) +
                                                  " bytes are more than the limit of " +
                                                  std::to_string(limits.max_bytes));
  }
  std::vector<std::byte> bytes(size);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    return failure(ErrorCode::kIo, path + ": cannot be read: " + std::strerror(errno));
  }
  return bytes;
}

std::string stem_of(const std::string& path) { return fs::path(path).stem().string(); }

bool has_picture_ending(const std::string& path) {
  static constexpr std::array<std::string_view, 6> kEndings = {".png", ".tif", ".tiff",
                                                               ".pgm", ".npy", ".raw"};
  return std::find(kEndings.begin(), kEndings.end(), lower_ending(path)) != kEndings.end();
}

bool has_raw_ending(const std::string& path) { return lower_ending(path) == ".raw"; }

bool natural_less(std::string_view a, std::string_view b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto number = [&](std::string_view text, std::size_t& at) {
        const std::size_t first = std::min(text.find_first_not_of('0', at), text.size());
        at = first;
        while (at < text.size() && is_digit(text[at])) {
          ++at;
        }
        return text.substr(first, at - first);
      };
      const std::string_view x = number(a, i);
      const std::string_view y = number(b, j);
      if (x.size() != y.size()) {
        return x.size() < y.size();
      }
      if (x != y) {
        return x < y;
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

Result<std::vector<std::string>> expand_input(const std::string& input) {
  std::error_code error;
  if (fs::is_directory(input, error)) {
    return list_directory(input);
  }
  if (!fs::exists(input, error) && input.find_first_of("*?[") != std::string::npos) {
    return match_glob(input);
  }
  return std::vector<std::string>{input};
}

}  // namespace thermedge::io
