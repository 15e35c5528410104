#include "thermedge/io/config.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <type_traits>
#include <vector>

#include "config/table_reader.hpp"
#include "thermedge/io/source_options.hpp"
#include "thermedge/similar_names.hpp"

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
    return failure(ErrorCode::kInvalidArgument, unknown_option(std::string(key_)),
                   std::string(key_));
  }

 private:
  bool matches(std::string_view name) {
    const bool is_match = prefix_ + std::string(name) == key_;
    found_ = found_ || is_match;
    return is_match;
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

// Bytes of a file of options, at most: far above the largest, and a device does not end.
constexpr std::size_t kMostConfigBytes = std::size_t{16} << 20;

Result<std::string> read_text(const std::string& path) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found) {
    return failure(ErrorCode::kIo, path + ": no such file; should be a TOML file of options");
  }
  if (kind == std::filesystem::file_type::directory) {
    return failure(ErrorCode::kIo, path + ": is a directory; should be a TOML file of options");
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostConfigBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad() || (!file.is_open())) {
    return failure(ErrorCode::kIo, path + ": cannot be read; should be a TOML file of options");
  }
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMostConfigBytes) {
    return failure(ErrorCode::kBadData,
                   path + ": is longer than 16 MiB; should be a TOML file of options");
  }
  return text;
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

// Names and values of all options as text.
class OptionCollector {
 public:
  template <class T>
  void operator()(std::string_view name, const T& field, Bounds, std::string_view help) {
    if constexpr (std::is_same_v<T, bool>) {
      add(name, field ? "true" : "false", help, {"true", "false"});
    } else {
      add(name, detail::shortest_text(static_cast<double>(field)), help, {});
    }
  }
  template <class E, class Names>
  requires std::is_enum_v<E>
  void operator()(std::string_view name, const E& field, const Names& names,
                  std::string_view help) {
    std::string value;
    std::vector<std::string> choices;
    for (const auto& known : names) {
      choices.emplace_back(known.name);
      value = known.value == field ? choices.back() : value;
    }
    add(name, value, help, std::move(choices));
  }
  template <class Unit, std::size_t N>
  void operator()(std::string_view name, const Quantity<Unit>& field,
                  const QuantityRange<Unit, N>& range, std::string_view help) {
    add(name, detail::quantity_text(field, range.units), help, {});
  }
  template <class O>
  void group(std::string_view name, const O& nested) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    groups.push_back(outer + std::string(name));
    visit_options(nested, *this);
    prefix_ = outer;
  }

  std::vector<OptionInfo> options;
  std::vector<std::string> groups;

 private:
  void add(std::string_view name, std::string value, std::string_view help,
           std::vector<std::string> choices) {
    options.push_back(
        {prefix_ + std::string(name), std::move(value), std::string(help), std::move(choices)});
  }
  std::string prefix_;
};

template <class Options>
OptionCollector collect(const Options& options) {
  OptionCollector collector;
  visit_options(options, collector);
  return collector;
}

bool has_name(const OptionCollector& known, const std::string& name) {
  return std::find(known.groups.begin(), known.groups.end(), name) != known.groups.end() ||
         std::any_of(known.options.begin(), known.options.end(),
                     [&](const OptionInfo& option) { return option.name == name; });
}

std::string last_word(std::string_view name) {
  return std::string(name.substr(name.rfind('.') + 1));
}

// What may have been meant: a name that is spelled much alike, or the same or a similar last word
// in another stage.
std::string hint_for(const std::string& key, const OptionCollector& known) {
  std::vector<std::string> names = known.groups;
  names.emplace_back("source");
  for (const OptionInfo& option : known.options) {
    names.push_back(option.name);
  }
  std::string hint = did_you_mean(key, names);
  if (hint.empty()) {
    std::string owners;
    for (const std::string& name : names) {
      owners += last_word(name) == last_word(key) ? (owners.empty() ? "" : " or ") + name : "";
    }
    hint = owners.empty() ? "" : "; did you mean " + owners + "?";
  }
  return hint.empty() ? "; --dump-config lists all options" : hint;
}

template <class Options>
Error explain_unknown(Error error, const Options& options) {
  if (!error.option.empty()) {
    error.message += hint_for(error.option, collect(options));
  }
  return error;
}

// Where an unknown option belongs to another preset, says so.
Error explain_unknown(Error error, const DetectorOptions& options) {
  const OptionCollector own = collect(options);
  if (error.option.empty() || has_name(own, error.option)) {
    return error;
  }
  for (const auto& [preset, name] : kPresets) {
    if (preset != options.preset() && has_name(collect(DetectorOptions(preset)), error.option)) {
      error.message += ": preset " + std::string(preset_name(options.preset())) +
                       " does not use it, preset " + std::string(name) + " does";
      return error;
    }
  }
  error.message += hint_for(error.option, own);
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

// The parser's words may quote the file.
std::string on_one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char letter) { return letter < ' ' || letter == 127; },
      ' ');
  return line;
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
    return failure(ErrorCode::kBadData,
                   name + ": line " + std::to_string(error.source().begin.line) + ": not TOML: " +
                       on_one_line(error.description()) + "; a line should read option = value, " +
                       "[stage] or # comment, with texts in quotes");
  }
}

// Sets the options in the table, all of them or, on error, none. Whether they go together is
// checked when all that follows has been set. `source`: null where a table [source] is an error.
template <class Options>
Status take_table(const toml::table& table, Options changed, Options& options,
                  SourceOptions* source) {
  SourceOptions changed_source = source != nullptr ? *source : SourceOptions();
  TableReader reader(table, "");
  reader.tick_off("preset");
  if (source != nullptr) {
    reader.tick_off("source");
  }
  visit_options(changed, reader);
  return reader.finish()
      .map_error([&](Error error) { return explain_unknown(std::move(error), changed); })
      .and_then([&] { return check_ranges(changed, ""); })
      .and_then([&] { return source != nullptr ? read_source(table, changed_source) : Status(); })
      .map([&] {
        options = changed;
        if (source != nullptr) {
          *source = changed_source;
        }
      });
}

// The preset that a table names; `otherwise` where it names none.
Result<Preset> preset_of(const toml::table& table, Preset otherwise) {
  const toml::node* node = table.get("preset");
  if (node == nullptr) {
    return otherwise;
  }
  const auto chosen = node->value<std::string_view>();
  if (!chosen || !node->is_string()) {
    return failure(ErrorCode::kInvalidArgument,
                   "preset should be one of " + list_names(kPresets) + " in quotes");
  }
  Preset preset = otherwise;
  return assign_enum("preset", *chosen, kPresets, preset).map([&] { return preset; });
}

// Applies to `options` what `changed` has otherwise than its own preset has it.
Status carry_over(const DetectorOptions& changed, DetectorOptions& options) {
  const std::vector<OptionInfo> values = collect(changed).options;
  const std::vector<OptionInfo> usual = collect(DetectorOptions(changed.preset())).options;
  DetectorOptions result = options;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].value != usual[i].value) {
      Status status = apply_setting(values[i].name + "=" + values[i].value, result);
      if (!status) {
        return status;
      }
    }
  }
  options = result;
  return {};
}

Status parse(std::string_view toml, const std::string& name, PresetChoice choice,
             DetectorOptions& options, SourceOptions* source) {
  return with_table(toml, name, [&](const toml::table& table) {
    return preset_of(table, options.preset()).and_then([&](Preset preset) {
      const bool is_kept = table.get("preset") == nullptr || preset == options.preset();
      const DetectorOptions start = is_kept ? options : DetectorOptions(preset);
      if (is_kept || choice == PresetChoice::kFree) {
        return take_table(table, start, options, source);
      }
      DetectorOptions of_file(preset);
      SourceOptions of_sources = source != nullptr ? *source : SourceOptions();
      return take_table(table, start, of_file, source != nullptr ? &of_sources : nullptr)
          .and_then([&] { return carry_over(of_file, options); })
          .map([&] {
            if (source != nullptr) {
              *source = of_sources;
            }
          });
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
      return take_table(table, options, options, source);
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
    return failure(ErrorCode::kInvalidArgument,
                   "preset is no single option; choose it with --preset or in a file of options");
  }
  return apply_to(setting, options).map_error([&](Error error) {
    return explain_unknown(std::move(error), options);
  });
}

Status apply_setting(std::string_view setting, FrameDenoiserOptions& options) {
  return apply_to(setting, options).map_error([&](Error error) {
    return explain_unknown(std::move(error), options);
  });
}

std::vector<OptionInfo> list_options() {
  std::vector<OptionInfo> options;
  for (const auto& known : kPresets) {
    for (OptionInfo& option : collect(DetectorOptions(known.value)).options) {
      const bool is_new =
          std::none_of(options.begin(), options.end(),
                       [&](const OptionInfo& other) { return other.name == option.name; });
      if (is_new) {
        options.push_back(std::move(option));
      }
    }
  }
  return options;
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
