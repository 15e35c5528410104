// Where `scale` and `denoise` put their pictures.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "common.hpp"

namespace thermedge::cli {

// The file of each result: OUT itself where it has a picture's ending, else OUT/<stem><ending>.
class PictureOutput {
 public:
  // Fails where -o is missing, has an ending that is not written, or is an input or its folder.
  [[nodiscard]] static Result<PictureOutput> create(const std::string& output,
                                                    const InputFiles& inputs);

  [[nodiscard]] Room room() const { return one_file_ ? Room::kOne : Room::kMany; }
  // `ending`: of a file in a directory.
  [[nodiscard]] Result<std::string> path(const std::string& stem,
                                         const std::string& ending = ".png");

  // A file for the whole run: in the directory, or beside the one picture with its name in front.
  [[nodiscard]] Result<std::string> beside(const std::string& name) const;

 private:
  PictureOutput(const std::string& output, bool one_file, const InputFiles& inputs);

  std::string output_;
  InputFiles inputs_;
  OutputDirectory directory_;
  bool one_file_;
};

}  // namespace thermedge::cli
