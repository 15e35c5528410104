// What -o names, and the rule that no output is an input: the one place for both.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "thermedge/result.hpp"

namespace thermedge::cli {

enum class OutputKind : std::uint8_t { kNone, kStandardOutput, kFile, kDirectory };

struct OutputTarget {
  OutputKind kind = OutputKind::kNone;
  std::string ending;  // of a file, in small letters
};

// "" names nothing, "-" standard output. A name with one of `endings` (".png", in small letters;
// the name may have capital ones) is a file; a directory that exists, a name that ends in "/" and
// one without an ending is a directory. Another ending is an error that names those that are
// written.
[[nodiscard]] Result<OutputTarget> parse_output(const std::string& output,
                                                std::span<const std::string_view> endings);

// The files that a command reads, known by what they are and not by how they are spelled: links and
// other spellings of a path are the same file.
class InputFiles {
 public:
  InputFiles() = default;
  // Files, directories and globs as the user named them; "-", "sim:..." and what is not there are
  // passed over. `with_raw`: see io::expand_input.
  InputFiles(const std::vector<std::string>& inputs, bool with_raw);
  // One more file; nothing where the name is empty.
  void add(const std::string& path);
  void add_all(const std::vector<std::string>& inputs, bool with_raw);

  // Fails where `path` is one of the files. `option` ("-o") stands in front of the message.
  [[nodiscard]] Status check_file(std::string_view option, const std::string& path) const;
  // Fails where one of the files lies in `directory`.
  [[nodiscard]] Status check_directory(std::string_view option, const std::string& directory) const;
  // The same for `directory` and its folders of these names, where results of a kind each lie.
  [[nodiscard]] Status check_directories(std::string_view option, const std::string& directory,
                                         std::span<const std::string> folders) const;

 private:
  struct Identity {
    std::uint64_t device = 0;
    std::uint64_t number = 0;
    friend bool operator<(const Identity& a, const Identity& b) {
      return std::pair(a.device, a.number) < std::pair(b.device, b.number);
    }
  };
  using Names = std::map<Identity, std::string>;
  static std::optional<Identity> identity_of(const std::string& path);
  static void insert(const std::string& path, const std::string& name, Names& names);
  static const std::string* find(const std::string& path, const Names& names);

  Names files_;
  Names folders_;  // that hold them, with the name of one of the files
};

}  // namespace thermedge::cli
