// Rows of a CSV file. Private.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "thermedge/detection.hpp"

namespace thermedge::io {

// A row of cells; numbers do not depend on the locale.
class CsvText {
 public:
  CsvText& operator<<(std::string_view cell) {
    text_ += cell;
    text_ += ',';
    return *this;
  }
  CsvText& operator<<(std::int64_t cell) { return append(cell); }
  // Empty where it is not finite.
  CsvText& operator<<(double cell) { return std::isfinite(cell) ? append(cell) : *this << ""; }
  void end_row() { text_.back() = '\n'; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <class T>
  CsvText& append(T cell) {
    char digits[32];
    const auto written = std::to_chars(std::begin(digits), std::end(digits), cell);
    return *this << std::string_view(std::begin(digits), written.ptr);
  }

  std::string text_;
};

// The first two cells of each row: number and time of the frame.
[[nodiscard]] inline std::string frame_cells(const Detection& detection) {
  return std::to_string(detection.index) + "," +
         (detection.stamp_ns ? std::to_string(*detection.stamp_ns) : std::string());
}

}  // namespace thermedge::io
