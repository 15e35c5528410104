// A page of figures for people.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <string_view>

namespace thermedge::cli {

class Page {
 public:
  void line(const std::string& text) { text_ += text + "\n"; }
  void heading(std::string_view title) { text_ += fmt::format("\n{}\n", title); }
  void row(std::string_view label, const std::string& value, const std::string& meaning) {
    text_ += fmt::format("  {:<20} {:<12} {}\n", label, value, meaning);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

// "-" where there was nothing to measure on.
[[nodiscard]] inline std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

}  // namespace thermedge::cli
