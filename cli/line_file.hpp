// A file that grows with the frames of a run.
#pragma once

#include <string>
#include <string_view>

#include "thermedge/result.hpp"

namespace thermedge::cli {

// Each piece of text is in the file when write() returns, so that whoever follows the file sees it
// and whatever ends the program leaves it there.
class LineFile {
 public:
  explicit LineFile(std::string path) : path_(std::move(path)) {}
  LineFile(LineFile&& other) noexcept;
  LineFile& operator=(LineFile&& other) noexcept;
  ~LineFile();

  // `lines`: whole lines. The first call makes the file and its directory; a file of that name is
  // replaced. After a failure the file ends with the lines before.
  [[nodiscard]] Status write(std::string_view lines);

 private:
  [[nodiscard]] Status open();
  [[nodiscard]] tl::unexpected<Error> error(int reason) const;

  std::string path_;
  int descriptor_ = -1;
};

}  // namespace thermedge::cli
