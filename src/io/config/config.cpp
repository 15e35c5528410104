#include "thermedge/io/config.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>
#include <type_traits>
#include <vector>

#include "config/table_reader.hpp"
#include "thermedge/io/source_options.hpp"

namespace thermedge::io {
namespace {

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

// The table [source], whose values are texts or whole numbers.
Status read_source(const toml::table& table, SourceOptions& source) {
  const toml::node* node = table.get("source");
  if (node == nullptr) {
    return {};
  }
  const toml::table* options = node->as_table();
  if (options == nullptr) {
    return failure(ErrorCode::kInvalidArgument, "source should be a table of options");
  }
  for (const auto& [key, value] : *options) {
    const auto number = value.value<std::int64_t>();
    const std::string text =
        value.is_integer() ? std::to_string(*number) : value.value_or(std::string());
    const bool is_text = value.is_string() || value.is_integer();
    Status status = is_text ? set_source_option(key.str(), text, source)
                            : failure(ErrorCode::kInvalidArgument,
                                      "should be a text in quotes or a whole number");
    if (!status) {
      status.error().message = "line " + std::to_string(value.source().begin.line) + ": source." +
                               std::string(key.str()) + (is_text ? " = " + text : "") + ": " +
                               status.error().message;
      return status;
    }
  }
  return {};
}

// Parses the text and lets `use(table)` take it; the name stands in front of every error.
template <class Use>
Status with_table(std::string_view text, const std::string& name, Use&& use) {
  try {
    const toml::table table = toml::parse(text, name);
    return use(table).map_error([&](Error error) {
      error.message = name + ": " + error.message;
      return error;
    });
  } catch (const toml::parse_error& error) {
    return failure(ErrorCode::kBadData, name + ": line " +
                                            std::to_string(error.source().begin.line) +
                                            ": not TOML: " + std::string(error.description()));
  }
}

// Sets the options in the table, all of them or, on error, none. `source`: null where a table
// [source] is an error.
template <class Options, class Explain>
Status take_table(const toml::table& table, Options changed, Options& options,
                  SourceOptions* source, Explain&& explain) {
  SourceOptions changed_source = source != nullptr ? *source : SourceOptions();
  TableReader reader(table, "");
  reader.tick_off("preset");
  if (source != nullptr) {
    reader.tick_off("source");
  }
  visit_options(changed, reader);
  return reader.finish()
      .map_error([&](Error error) { return explain(std::move(error), changed); })
      .and_then([&] { return changed.check(); })
      .and_then([&] { return source != nullptr ? read_source(table, changed_source) : Status(); })
      .map([&] {
        options = changed;
        if (source != nullptr) {
          *source = changed_source;
        }
      });
}

// The options that a table starts from: those of its preset.
Result<DetectorOptions> start_of(const toml::table& table, PresetChoice choice,
                                 const DetectorOptions& options) {
  const toml::node* node = table.get("preset");
  if (node == nullptr) {
    return options;
  }
  const auto chosen = node->value<std::string_view>();
  if (!chosen || !node->is_string()) {
    return failure(ErrorCode::kInvalidArgument,
                   "preset should be one of " + list_names(kPresets) + " in quotes");
  }
  Preset preset = options.preset();
  if (Status status = assign_enum("preset", *chosen, kPresets, preset); !status) {
    return tl::unexpected(status.error());
  }
  if (choice == PresetChoice::kFixed && preset != options.preset()) {
    return failure(ErrorCode::kInvalidArgument, "preset = \"" + std::string(*chosen) +
                                                    "\", but --preset " +
                                                    std::string(preset_name(options.preset())) +
                                                    " was given; leave one of them out");
  }
  return DetectorOptions(preset);
}

Status parse(std::string_view toml, const std::string& name, PresetChoice choice,
             DetectorOptions& options, SourceOptions* source) {
  return with_table(toml, name, [&](const toml::table& table) {
    return start_of(table, choice, options).and_then([&](const DetectorOptions& start) {
      return take_table(table, start, options, source, explain_unknown);
    });
  });
}

}  // namespace

Status parse_config(std::string_view toml, const std::string& name, PresetChoice choice,
                    DetectorOptions& options) {
  return parse(toml, name, choice, options, nullptr);
}

Status load_config(const std::string& path, PresetChoice choice, DetectorOptions& options,
                   SourceOptions* source) {
  return read_text(path).and_then(
      [&](const std::string& text) { return parse(text, path, choice, options, source); });
}

Status load_config(const std::string& path, FrameDenoiserOptions& options, SourceOptions* source) {
  return read_text(path).and_then([&](const std::string& text) {
    return with_table(text, path, [&](const toml::table& table) {
      return take_table(table, options, options, source,
                        [](Error error, const FrameDenoiserOptions&) { return error; });
    });
  });
}

bool is_source_setting(std::string_view setting) { return setting.starts_with("source."); }

Status apply_setting(std::string_view setting, SourceOptions& options) {
  const std::size_t equals = std::min(setting.find('='), setting.size());
  if (!is_source_setting(setting) || equals == setting.size()) {
    return failure(ErrorCode::kInvalidArgument,
                   "'" + std::string(setting) + "' should read source.option=value");
  }
  const std::string_view key = setting.substr(0, equals);
  return set_source_option(key.substr(key.find('.') + 1), setting.substr(equals + 1), options)
      .map_error([&](Error error) {
        error.message = std::string(key) + " = " + std::string(setting.substr(equals + 1)) + ": " +
                        error.message;
        return error;
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
