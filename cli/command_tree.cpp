#include "command_tree.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "common.hpp"

namespace thermedge::cli {
namespace {

struct GroupOfOptions {
  std::string_view name;
  std::vector<std::string_view> options;
};

constexpr std::string_view kOwnGroup = "Options";

// What several commands share; the other options are their own.
const std::array kGroups = {
    GroupOfOptions{"Input",
                   {"--crop", "--byte-order", "--raw-size", "--raw-format", "--raw-header",
                    "--raw-frame-header", "--mask", "--invalid"}},
    GroupOfOptions{"Output", {"--output", "--write", "--format", "--panel-px"}},
    GroupOfOptions{"Configuration", {"--preset", "--config", "--set", "--dump-config"}},
    GroupOfOptions{kOwnGroup, {}},
    GroupOfOptions{"Run and messages",
                   {"--threads", "--simd", "--quiet", "--json-log", "--help", "--version"}}};

// Options whose value is a file or a directory.
constexpr std::array<std::string_view, 4> kFileOptions = {"--output", "--config", "--mask",
                                                          "--toml"};

std::vector<std::string> words_in_braces(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}', std::min(open, type.size()));
  return close == std::string::npos ? std::vector<std::string>()
                                    : split_list(type.substr(open + 1, close - open - 1));
}

// "0 to 1024" of "INT:INT in [0 - 1024]".
std::string limits_in(const std::string& type) {
  const std::size_t open = type.find('[');
  const std::size_t dash = type.find(" - ", std::min(open, type.size()));
  const std::size_t close = type.find(']', std::min(dash, type.size()));
  return close == std::string::npos ? ""
                                    : type.substr(open + 1, dash - open - 1) + " to " +
                                          type.substr(dash + 3, close - dash - 3);
}

// The parser's names of types tell nothing of what a value means.
std::string argument_of(const std::string& type, const OptionText& option) {
  const std::string word = type.substr(0, type.find_first_of(": "));
  if (option.takes_file) {
    return "FILE";
  }
  if (word == "INT" || word == "UINT") {
    return "N";
  }
  if (word == "TEXT" && !option.choices.empty()) {
    return "NAME";
  }
  return word == "TEXT" || word == "FLOAT" ? "VALUE" : word;
}

OptionText option_text(const CLI::Option& option) {
  OptionText text;
  text.name = option.get_positional() ? option.get_name(true) : "";
  if (!option.get_snames().empty()) {
    text.short_name = "-" + option.get_snames().front();
  }
  if (!option.get_lnames().empty()) {
    text.name = "--" + option.get_lnames().front();
  }
  const std::string type = option.get_type_name();
  text.choices = words_in_braces(type);
  text.limits = limits_in(type);
  text.usual = option.get_default_str();
  text.help = option.get_description();
  text.group = option.get_group();
  text.takes_file =
      (option.get_positional() && text.choices.empty()) || type.starts_with("FILE") ||
      std::find(kFileOptions.begin(), kFileOptions.end(), text.name) != kFileOptions.end();
  if (option.get_expected_max() > 0 && option.get_type_size() > 0) {
    text.argument = argument_of(type, text);
  }
  text.may_repeat = option.get_items_expected_max() > 1 ||
                    option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  text.is_required = option.get_required();
  return text;
}

}  // namespace

bool CommandText::has_option(const std::string& option) const {
  return std::any_of(options.begin(), options.end(),
                     [&](const OptionText& known) { return known.name == option; });
}

CommandText command_text(const CLI::App& command) {
  CommandText text{command.get_name(), command.get_description(), {}, {}};
  for (const CLI::Option* option : command.get_options({})) {
    (option->get_positional() ? text.positionals : text.options).push_back(option_text(*option));
  }
  return text;
}

std::vector<CommandText> commands_of(const CLI::App& program) {
  std::vector<CommandText> commands;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands.push_back(command_text(*command));
  }
  return commands;
}

void group_options(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    std::string name(kOwnGroup);
    for (const GroupOfOptions& group : kGroups) {
      for (const std::string_view member : group.options) {
        name = option->check_lname(std::string(member.substr(2))) ? group.name : name;
      }
    }
    option->group(name);
  }
}

const std::vector<std::string>& option_groups() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    std::transform(kGroups.begin(), kGroups.end(), std::back_inserter(list),
                   [](const GroupOfOptions& group) { return std::string(group.name); });
    return list;
  }();
  return names;
}

}  // namespace thermedge::cli
