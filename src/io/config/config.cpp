#include "thermedge/io/config.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <type_traits>
#include <vector>

namespace thermedge::io {
namespace {

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
        keep(failure(ErrorCode::kInvalidArgument,
                     "unknown option " + prefix_ + std::string(key.str()),
                     prefix_ + std::string(key.str())),
             &node);
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

// Finds one option by its full name and sets it from text.
class SettingApplier {
 public:
  SettingApplier(std::string_view key, std::string_view text) : key_(key), text_(text) {}

  template <class T>
  void operator()(std::string_view name, T& field, Bounds bounds, std::string_view) {
    if (matches(name)) {
      status_ = parse(field);
      check_range(static_cast<double>(field), bounds);
    }
  }

  template <class Unit, std::size_t N>
  void operator()(std::string_view name, Quantity<Unit>& field, const QuantityRange<Unit, N>& range,
                  std::string_view) {
    if (matches(name)) {
      status_ = assign_quantity(std::string(key_), text_, range.units, field);
      check_range(field.value, range.bounds);
    }
  }

  template <class E, class Names>
  requires std::is_enum_v<E>
  void operator()(std::string_view name, E& field, const Names& names, std::string_view) {
    if (matches(name)) {
      status_ = assign_enum(std::string(key_), text_, names, field);
    }
  }

  template <class O>
  void group(std::string_view name, O& options) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    visit_options(options, *this);
    prefix_ = outer;
  }

  Status finish() {
    if (found_) {
      return std::move(status_);
    }
    std::string message = "unknown option '" + std::string(key_) + "'";
    if (!similar_.empty()) {
      message += "; did you mean " + similar_ + "?";
    }
    return failure(ErrorCode::kInvalidArgument,
                   message + (similar_.empty() ? "; --dump-config lists all options" : ""),
                   std::string(key_));
  }

 private:
  bool matches(std::string_view name) {
    const std::string full = prefix_ + std::string(name);
    if (full == key_) {
      found_ = true;
      return true;
    }
    // The same last word, or the same stage: likely what was meant.
    const std::string_view wanted = key_.substr(key_.rfind('.') + 1);
    if (name == wanted || (!prefix_.empty() && key_.starts_with(prefix_))) {
      similar_ += (similar_.empty() ? "" : ", ") + full;
    }
    return false;
  }

  void check_range(double number, Bounds bounds) {
    if (status_ && !(number >= bounds.min && number <= bounds.max)) {
      status_ = failure(ErrorCode::kInvalidArgument,
                        detail::out_of_range(std::string(key_), number, bounds));
    }
  }

  template <class T>
  Status parse(T& field) {
    if constexpr (std::is_same_v<T, bool>) {
      if (text_ != "true" && text_ != "false") {
        return wrong_type<T>(std::string(key_), std::string(text_));
      }
      field = text_ == "true";
    } else {
      const char* end = text_.data() + text_.size();
      const auto [stop, error] = std::from_chars(text_.data(), end, field);
      if (error != std::errc{} || stop != end) {
        return wrong_type<T>(std::string(key_), std::string(text_));
      }
    }
    return {};
  }

  std::string_view key_;
  std::string_view text_;
  std::string prefix_;
  std::string similar_;
  bool found_ = false;
  Status status_;
};

class Dumper {
 public:
  template <class T>
  void operator()(std::string_view name, const T& field, Bounds, std::string_view help) {
    char number[32];
    std::string value;
    if constexpr (std::is_same_v<T, bool>) {
      value = field ? "true" : "false";
    } else {
      value.assign(std::begin(number),
                   std::to_chars(std::begin(number), std::end(number), field).ptr);
    }
    line(name, value, help);
  }

  template <class E, class Names>
  requires std::is_enum_v<E>
  void operator()(std::string_view name, const E& field, const Names& names,
                  std::string_view help) {
    for (const auto& known : names) {
      if (known.value == field) {
        line(name, '"' + std::string(known.name) + '"', help);
      }
    }
  }

  template <class Unit, std::size_t N>
  void operator()(std::string_view name, const Quantity<Unit>& field,
                  const QuantityRange<Unit, N>& range, std::string_view help) {
    const std::string text = detail::quantity_text(field, range.units);
    line(name, field.unit == range.units[0].value ? text : '"' + text + '"', help);
  }

  template <class O>
  void group(std::string_view name, const O& options) {
    const std::string outer = prefix_;
    prefix_ += (prefix_.empty() ? "" : ".") + std::string(name);
    text_ += "\n[" + prefix_ + "]\n";
    visit_options(options, *this);
    prefix_ = outer;
  }

  std::string take() { return std::move(text_); }

 private:
  void line(std::string_view name, const std::string& value, std::string_view help) {
    text_ += std::string(name) + " = " + value + "  # " + std::string(help) + "\n";
  }
  std::string prefix_;
  std::string text_;
};

Result<std::string> read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    return failure(ErrorCode::kIo, path + ": cannot be read as a configuration file");
  }
  return text.str();
}

template <class Options>
Status apply_to(std::string_view setting, Options& options) {
  const auto equals = setting.find('=');
  if (equals == std::string_view::npos) {
    return failure(ErrorCode::kInvalidArgument,
                   "'" + std::string(setting) + "' should read stage.option=value");
  }
  SettingApplier applier(setting.substr(0, equals), setting.substr(equals + 1));
  Options changed = options;
  visit_options(changed, applier);
  return applier.finish().map([&] { options = changed; });
}

// Full names of all options.
class NameCollector {
 public:
  template <class T, class Limits>
  void operator()(std::string_view name, const T&, const Limits&, std::string_view) {
    names.push_back(prefix_ + std::string(name));
  }
  template <class O>
  void group(std::string_view name, const O& options) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    names.push_back(outer + std::string(name));
    visit_options(options, *this);
    prefix_ = outer;
  }

  std::vector<std::string> names;

 private:
  std::string prefix_;
};

// Where an unknown option belongs to another preset, says so instead.
Error explain_unknown(Error error, const DetectorOptions& options) {
  if (error.option.empty()) {
    return error;
  }
  for (const auto& [preset, name] : kPresets) {
    const DetectorOptions other(preset);
    NameCollector known;
    visit_options(other, known);
    if (preset != options.preset() &&
        std::find(known.names.begin(), known.names.end(), error.option) != known.names.end()) {
      error.message = "unknown option '" + error.option + "': preset " +
                      std::string(preset_name(options.preset())) + " does not use it, preset " +
                      std::string(name) + " does";
      return error;
    }
  }
  return error;
}

}  // namespace

Status parse_config(std::string_view toml, const std::string& name, PresetChoice choice,
                    DetectorOptions& options) {
  try {
    const toml::table table = toml::parse(toml, name);
    DetectorOptions changed = options;
    if (table.contains("preset") && !table["preset"].is_string()) {
      return failure(ErrorCode::kInvalidArgument,
                     name + ": preset should be one of " + list_names(kPresets) + " in quotes");
    }
    if (const auto chosen = table["preset"].value<std::string_view>()) {
      Preset preset = options.preset();
      if (Status status = assign_enum("preset", *chosen, kPresets, preset); !status) {
        return failure(status.error().code, name + ": " + status.error().message);
      }
      if (choice == PresetChoice::kFixed && preset != options.preset()) {
        return failure(ErrorCode::kInvalidArgument, name + ": preset = \"" + std::string(*chosen) +
                                                        "\", but --preset " +
                                                        std::string(preset_name(options.preset())) +
                                                        " was given; leave one of them out");
      }
      changed = DetectorOptions(preset);
    }
    TableReader reader(table, "");
    reader.tick_off("preset");
    visit_options(changed, reader);
    return reader.finish()
        .map_error([&](Error error) { return explain_unknown(std::move(error), changed); })
        .and_then([&] { return changed.check(); })
        .map([&] { options = changed; })
        .map_error([&](Error error) {
          error.message = name + ": " + error.message;
          return error;
        });
  } catch (const toml::parse_error& error) {
    return failure(ErrorCode::kBadData, name + ": line " +
                                            std::to_string(error.source().begin.line) +
                                            ": not TOML: " + std::string(error.description()));
  }
}

Status load_config(const std::string& path, PresetChoice choice, DetectorOptions& options) {
  return read_text(path).and_then(
      [&](const std::string& text) { return parse_config(text, path, choice, options); });
}

Status load_config(const std::string& path, FrameDenoiserOptions& options) {
  return read_text(path).and_then([&](const std::string& text) -> Status {
    try {
      const toml::table table = toml::parse(text, path);
      FrameDenoiserOptions changed = options;
      TableReader reader(table, "");
      visit_options(changed, reader);
      return reader.finish()
          .and_then([&] { return changed.check(); })
          .map([&] { options = changed; })
          .map_error([&](Error error) {
            error.message = path + ": " + error.message;
            return error;
          });
    } catch (const toml::parse_error& error) {
      return failure(ErrorCode::kBadData, path + ": line " +
                                              std::to_string(error.source().begin.line) +
                                              ": not TOML: " + std::string(error.description()));
    }
  });
}

Status apply_setting(std::string_view setting, DetectorOptions& options) {
  if (setting.substr(0, setting.find('=')) == "preset") {
    return failure(
        ErrorCode::kInvalidArgument,
        "preset is no single option; choose it with --preset or in the file of --config");
  }
  return apply_to(setting, options).map_error([&](Error error) {
    return explain_unknown(std::move(error), options);
  });
}

Status apply_setting(std::string_view setting, FrameDenoiserOptions& options) {
  return apply_to(setting, options);
}

std::string dump_config(const DetectorOptions& options) {
  Dumper dumper;
  visit_options(options, dumper);
  return "preset = \"" + std::string(preset_name(options.preset())) +
         "\"  # where the other options start from\n" + dumper.take();
}

std::string dump_config(const FrameDenoiserOptions& options) {
  Dumper dumper;
  visit_options(options, dumper);
  return dumper.take();
}

}  // namespace thermedge::io
