// Lists of options: every option stands once, in its stage's header, with its name, range and
// meaning. Range checks, the TOML reader and writer, `--set`, the flags of the command line and
// `--dump-config` all walk these lists.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
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

// A number with its unit, in TOML and on the command line one text: "3sigma". Default: 0 of the
// first unit.
template <class Unit>
struct Quantity {
  double value = 0;
  Unit unit = Unit{};

  friend bool operator==(const Quantity&, const Quantity&) = default;
};

// Range of the number of a quantity, whatever its unit, and the names of the units; a bare number
// is in the first one.
template <class Unit, std::size_t N>
struct QuantityRange {
  Bounds bounds;
  std::array<EnumName<Unit>, N> units;
};
template <class Unit, std::size_t N>
QuantityRange(Bounds, std::array<EnumName<Unit>, N>) -> QuantityRange<Unit, N>;

template <class O, class Options>
concept OptionsOf = std::same_as<std::remove_const_t<O>, Options>;

// visit_options(options, visitor), one overload beside each options struct, calls for each field in
// order
//   visitor(name, field, bounds, help)   numbers: bool, int, double (bool has bounds 0..1)
//   visitor(name, field, names, help)    enumerations; `names` is an array of EnumName
//   visitor(name, field, range, help)    quantities; `range` is a QuantityRange
//   visitor.group(name, options)         nested structs, whose options are called "<name>.<option>"

namespace detail {

// The shortest text that reads back as the same number.
[[nodiscard]] std::string shortest_text(double value);

// As it reads in TOML and on the command line, "3sigma"; a bare number in the first unit.
template <class Unit, std::size_t N>
[[nodiscard]] std::string quantity_text(const Quantity<Unit>& quantity,
                                        const std::array<EnumName<Unit>, N>& units) {
  std::string text = shortest_text(quantity.value);
  for (std::size_t i = 1; i < N; ++i) {
    text += units[i].value == quantity.unit ? units[i].name : std::string_view{};
  }
  return text;
}

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
  template <class Unit, std::size_t N>
  void operator()(std::string_view name, const Quantity<Unit>& quantity,
                  const QuantityRange<Unit, N>& range, std::string_view help) {
    (*this)(name, quantity.value, range.bounds, help);
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
