#include "thermedge/option_list.hpp"

#include <charconv>
#include <iterator>

namespace thermedge::detail {

std::string shortest_text(double value) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  return {std::begin(text), end};
}

std::string out_of_range(const std::string& name, double value, Bounds bounds) {
  return name + " = " + shortest_text(value) + " is out of range: " + shortest_text(bounds.min) +
         " to " + shortest_text(bounds.max);
}

}  // namespace thermedge::detail
