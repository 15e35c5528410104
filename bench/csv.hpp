// A table that is shown while it grows and written as a whole.
#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

#include "thermedge/io/write.hpp"
#include "value_or_exit.hpp"

namespace thermedge::bench {

class Csv {
 public:
  Csv(std::string path, const std::string& header) : path_(std::move(path)) { add(header); }
  // A row without its line end.
  void add(const std::string& row) {
    fmt::print("{}\n", row);
    text_ += row + "\n";
  }
  void write() const { value_or_exit(io::write_file(path_, text_)); }

 private:
  std::string path_;
  std::string text_;
};

}  // namespace thermedge::bench
