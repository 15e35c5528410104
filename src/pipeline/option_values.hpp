// The values of a set of options, to compare two sets.
#pragma once

#include <string_view>
#include <vector>

#include "thermedge/option_list.hpp"

namespace thermedge::detail {

// In the order of the list; names are those within their group.
class OptionValues {
 public:
  template <class O>
  explicit OptionValues(const O& options) {
    visit_options(options, *this);
  }

  template <class T, class Limits>
  void operator()(std::string_view name, const T& value, const Limits&, std::string_view) {
    names.push_back(name);
    values.push_back(static_cast<double>(value));
  }
  template <class O>
  void group(std::string_view, const O& options) {
    visit_options(options, *this);
  }
  friend bool operator==(const OptionValues&, const OptionValues&) = default;

  std::vector<std::string_view> names;
  std::vector<double> values;
};

}  // namespace thermedge::detail
