// Lists of options: every option stands once, in its stage's header, with its name, range and
// meaning. Range checks, the TOML reader and writer, `--set`, the flags of the command line and
// `--dump-config` all walk these lists.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "thermedge/result.hpp"

namespace thermedge {

struct Bounds {
  double min;
  double max;
};

// One value of an enumeration and its name in TOML and on the command line.
template <class E>
struct EnumName {
  E value;
  std::string_view name;
};
template <class E>
EnumName(E, std::string_view) -> EnumName<E>;

template <class O, class Options>
concept OptionsOf = std::same_as<std::remove_const_t<O>, Options>;

// visit_options(options, visitor), one overload beside each options struct, calls for each field in
// order
//   visitor(name, field, bounds, help)   numbers: bool, int, double (bool has bounds 0..1)
//   visitor(name, field, names, help)    enumerations; `names` is an array of EnumName
//   visitor.group(name, options)         nested structs, whose options are called "<name>.<option>"

namespace detail {

// The shortest text that reads back as the same number.
[[nodiscard]] std::string shortest_text(double value);

[[nodiscard]] std::string out_of_range(const std::string& name, double value, Bounds bounds);

// Remembers the first option that is not finite or out of its range. Allocates only then.
class RangeChecker {
 public:
  template <class T>
  void operator()(std::string_view name, const T& value, Bounds bounds, std::string_view) {
    const auto number = static_cast<double>(value);
    if (name_.empty() && !(number >= bounds.min && number <= bounds.max)) {
      name_ = name;
      value_ = number;
      bounds_ = bounds;
    }
  }
  template <class E, class Names>
  requires std::is_enum_v<E>
  void operator()(std::string_view, const E&, const Names&, std::string_view) {}

  template <class O>
  void group(std::string_view name, const O& options) {
    RangeChecker nested;
    visit_options(options, nested);
    if (name_.empty() && !nested.name_.empty()) {
      *this = nested;
      name_.insert(0, std::string(name) + ".");
    }
  }
  [[nodiscard]] Status status(std::string_view prefix) const {
    return name_.empty() ? Status{}
                         : failure(ErrorCode::kInvalidArgument,
                                   out_of_range(std::string(prefix) + name_, value_, bounds_),
                                   std::string(prefix) + name_);
  }

 private:
  std::string name_;
  double value_ = 0;
  Bounds bounds_{0, 0};
};

}  // namespace detail

// Fails on the first option out of range, naming it as `prefix` + name.
template <class O>
[[nodiscard]] Status check_ranges(const O& options, std::string_view prefix) {
  detail::RangeChecker checker;
  visit_options(options, checker);
  return checker.status(prefix);
}

}  // namespace thermedge
