// Where `scale` and `denoise` put their pictures.
#pragma once

#include <string>

#include "common.hpp"

namespace thermedge::cli {

// The file of each result: OUT itself where it has a picture's ending, else OUT/<stem>.png.
class PictureOutput {
 public:
  explicit PictureOutput(const std::string& output);

  [[nodiscard]] Result<std::string> path(const std::string& stem);

  // A file for the whole run: in the directory, or beside the one picture with its name in front.
  [[nodiscard]] std::string beside(const std::string& name) const;

 private:
  std::string output_;
  OutputDirectory directory_;
  bool one_file_;
  int written_ = 0;
};

}  // namespace thermedge::cli
