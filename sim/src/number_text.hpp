// Numbers as people write them.
#pragma once

#include <charconv>
#include <iterator>
#include <string>

namespace thermedge::sim {

// The shortest text without an exponent that reads back as the value; never depends on the locale.
// |value| up to 1e16.
[[nodiscard]] inline std::string number_text(double value) {
  char text[400];
  return {std::begin(text),
          std::to_chars(std::begin(text), std::end(text), value, std::chars_format::fixed).ptr};
}

}  // namespace thermedge::sim
