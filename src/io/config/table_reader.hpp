// Options out of TOML tables.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

template <class Names>
std::string list_names(const Names& names) {
  std::string list;
  for (const auto& known : names) {
    list += (list.empty() ? "" : ", ") + std::string(known.name);
  }
  return list;
}

template <class E, class Names>
Status assign_enum(const std::string& key, std::string_view text, const Names& names, E& field) {
  for (const auto& known : names) {
    if (known.name == text) {
      field = known.value;
      return {};
    }
  }
  return failure(ErrorCode::kInvalidArgument,
                 key + " = '" + std::string(text) + "' is none of " + list_names(names));
}

// "3sigma", "3 sigma" or, in the first unit, "3".
template <class Unit, std::size_t N>
Status assign_quantity(const std::string& key, std::string_view text,
                       const std::array<EnumName<Unit>, N>& units, Quantity<Unit>& field) {
  Quantity<Unit> read{0, units[0].value};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, read.value);
  std::string_view name(stop, static_cast<std::size_t>(end - stop));
  name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
  const auto unit = std::find_if(units.begin(), units.end(),
                                 [&](const EnumName<Unit>& known) { return known.name == name; });
  if (error != std::errc{} || !(name.empty() || unit != units.end())) {
    return failure(ErrorCode::kInvalidArgument,
                   key + " = '" + std::string(text) + "' should be a number of " +
                       std::string(units[0].name) + ", or a number and one of the units " +
                       list_names(units));
  }
  read.unit = name.empty() ? read.unit : unit->value;
  field = read;
  return {};
}

template <class T>
constexpr std::string_view kind_of() {
  return std::is_same_v<T, bool> ? "true or false"
         : std::is_integral_v<T> ? "a whole number"
                                 : "a number";
}

template <class T>
Status wrong_type(const std::string& key, const std::string& text) {
  return failure(ErrorCode::kInvalidArgument,
                 key + " = " + text + " should be " + std::string(kind_of<T>()));
}

inline std::string unknown_option(const std::string& name) {
  return "unknown option '" + name + "'";
}

// Sets fields from the nodes of a TOML table and ticks off the keys it knew.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string prefix)
      : table_(table), prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(std::string_view name, T& field, Bounds, std::string_view) {
    if (const toml::node* node = take(name)) {
      const auto value = exact_value<T>(*node);
      if (value) {
        field = *value;
      } else {
        keep(wrong_type<T>(prefix_ + std::string(name), text_of(*node)), node);
      }
    }
  }

  template <class E, class Names>
  requires std::is_enum_v<E>
  void operator()(std::string_view name, E& field, const Names& names, std::string_view) {
    if (const toml::node* node = take(name)) {
      keep(assign_enum(prefix_ + std::string(name), node->value_or(std::string_view{}), names,
                       field),
           node);
    }
  }

  template <class Unit, std::size_t N>
  void operator()(std::string_view name, Quantity<Unit>& field, const QuantityRange<Unit, N>& range,
                  std::string_view) {
    if (const toml::node* node = take(name)) {
      const std::string text = node->value<std::string>().value_or(text_of(*node));
      keep(assign_quantity(prefix_ + std::string(name), text, range.units, field), node);
    }
  }

  template <class O>
  void group(std::string_view name, O& options) {
    const toml::node* node = take(name);
    if (node == nullptr) {
      return;
    }
    if (const toml::table* table = node->as_table()) {
      TableReader nested(*table, prefix_ + std::string(name) + ".");
      visit_options(options, nested);
      keep(nested.finish(), nullptr);
    } else {
      keep(failure(ErrorCode::kInvalidArgument,
                   prefix_ + std::string(name) + " should be a table of options"),
           node);
    }
  }

  // A key that is not in the list.
  void tick_off(std::string_view name) { taken_.push_back(name); }

  // The first fault: a bad value, else a key that no option has.
  Status finish() {
    for (const auto& [key, node] : table_) {
      if (std::find(taken_.begin(), taken_.end(), key.str()) == taken_.end()) {
        const std::string name = prefix_ + std::string(key.str());
        keep(failure(ErrorCode::kInvalidArgument, unknown_option(name), name), &node);
      }
    }
    return std::move(status_);
  }

 private:
  const toml::node* take(std::string_view name) {
    taken_.push_back(name);
    return table_.get(name);
  }

  // A number for a double, a whole one for an int, a boolean for a bool; nothing else.
  template <class T>
  static std::optional<T> exact_value(const toml::node& node) {
    const bool fits = std::is_same_v<T, bool>     ? node.is_boolean()
                      : std::is_same_v<T, double> ? node.is_number()
                                                  : node.is_integer();
    return fits ? node.value<T>() : std::nullopt;
  }

  static std::string text_of(const toml::node& node) {
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    return text.str();
  }

  void keep(Status status, const toml::node* node) {
    if (!status && status_) {
      if (node != nullptr) {
        status.error().message =
            "line " + std::to_string(node->source().begin.line) + ": " + status.error().message;
      }
      status_ = std::move(status);
    }
  }

  const toml::table& table_;
  std::string prefix_;
  std::vector<std::string_view> taken_;
  Status status_;
};

}  // namespace thermedge::io
