#include "output.hpp"

#include <fmt/core.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <system_error>

#include "thermedge/io/files.hpp"

namespace thermedge::cli {
namespace {

namespace fs = std::filesystem;

// "v1.2" and "2024-05-01.run3" are names of directories as well as any: what follows the dot of an
// ending begins with a letter.
bool has_ending(const std::string& ending) {
  return ending.size() > 1 && std::isalpha(static_cast<unsigned char>(ending[1])) != 0 &&
         std::all_of(ending.begin() + 1, ending.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0; });
}

std::string list_of(std::span<const std::string_view> endings) {
  std::string list;
  for (std::size_t i = 0; i < endings.size(); ++i) {
    list += i == 0 ? "" : i + 1 == endings.size() ? " or " : ", ";
    list += endings[i];
  }
  return list;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

Result<OutputTarget> parse_output(const std::string& output,
                                  std::span<const std::string_view> endings) {
  if (output.empty() || output == "-") {
    return OutputTarget{output.empty() ? OutputKind::kNone : OutputKind::kStandardOutput, ""};
  }
  std::error_code error;
  const std::string ending = io::ending_of(output);
  if (output.ends_with('/') || fs::is_directory(output, error) || !has_ending(ending)) {
    return OutputTarget{OutputKind::kDirectory, ""};
  }
  if (endings.empty()) {
    return failure(
        ErrorCode::kInvalidArgument,
        fmt::format("-o {}: should be a directory; where its name has a dot in it, end it in /",
                    output));
  }
  if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    return failure(ErrorCode::kInvalidArgument,
                   fmt::format("-o {}: {} files are not written; the name of a file should end in "
                               "{}, that of a new directory in /",
                               output, ending, list_of(endings)));
  }
  return OutputTarget{OutputKind::kFile, ending};
}

std::optional<InputFiles::Identity> InputFiles::identity_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return std::nullopt;
  }
  return Identity{static_cast<std::uint64_t>(status.st_dev),
                  static_cast<std::uint64_t>(status.st_ino)};
}

InputFiles::InputFiles(const std::vector<std::string>& inputs, bool with_raw) {
  add_all(inputs, with_raw);
}

void InputFiles::add_all(const std::vector<std::string>& inputs, bool with_raw) {
  for (const std::string& input : inputs) {
    const auto files = io::expand_input(input, with_raw);
    for (const std::string& file : files.value_or(std::vector<std::string>())) {
      add(file);
    }
  }
}

// The folder of a link and the folder of what it points to: writing into either may replace it.
void InputFiles::add(const std::string& path) {
  std::error_code error;
  if (path.empty() || !fs::is_regular_file(path, error)) {
    return;
  }
  insert(path, path, files_);
  insert(folder_of(path).string(), path, folders_);
  if (fs::is_symlink(path, error)) {
    insert(folder_of(fs::canonical(path, error)).string(), path, folders_);
  }
}

void InputFiles::insert(const std::string& path, const std::string& name, Names& names) {
  if (const auto identity = identity_of(path)) {
    names.try_emplace(*identity, name);
  }
}

const std::string* InputFiles::find(const std::string& path, const Names& names) {
  const auto identity = identity_of(path);
  const auto place = identity ? names.find(*identity) : names.end();
  return place != names.end() ? &place->second : nullptr;
}

Status InputFiles::check_file(std::string_view option, const std::string& path) const {
  if (const std::string* input = find(path, files_)) {
    return failure(ErrorCode::kInvalidArgument,
                   fmt::format("{} {}: is the input {}, which would be replaced; give another name",
                               option, path, *input));
  }
  return {};
}

Status InputFiles::check_directory(std::string_view option, const std::string& directory) const {
  if (const std::string* input = find(directory, folders_)) {
    return failure(
        ErrorCode::kInvalidArgument,
        fmt::format("{} {}: is the folder of the input {}, which results may replace; give "
                    "another directory",
                    option, directory, *input));
  }
  return {};
}

Status InputFiles::check_directories(std::string_view option, const std::string& directory,
                                     std::span<const std::string> folders) const {
  Status status = check_directory(option, directory);
  for (const std::string& folder : folders) {
    status = status.and_then([&] {
      return check_directory(option, (std::filesystem::path(directory) / folder).string());
    });
  }
  return status;
}

}  // namespace thermedge::cli
