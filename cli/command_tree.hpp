// The commands and their options as data: what help, manual pages and completions are made from.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace thermedge::cli {

// An option or a positional argument.
struct OptionText {
  std::string short_name;            // "-o"; may be empty
  std::string name;                  // "--output"; of a positional argument "INPUT"
  std::string argument;              // "FILE"; empty where the option takes none
  std::vector<std::string> choices;  // all values, where they are names
  std::string limits;                // "0 to 1024", of numbers; may be empty
  std::string usual;                 // the value without the option, where the parser knows it
  std::string help;
  std::string group;
  bool takes_file = false;
  bool may_repeat = false;
  bool is_required = false;
};

struct CommandText {
  std::string name;
  std::string description;
  std::vector<OptionText> positionals;
  std::vector<OptionText> options;

  [[nodiscard]] bool has_option(const std::string& option) const;
};

[[nodiscard]] CommandText command_text(const CLI::App& command);
// The commands of the program, in their order.
[[nodiscard]] std::vector<CommandText> commands_of(const CLI::App& program);

// Sorts the options of a command into the groups of help, whose names they get.
void group_options(CLI::App& command);
// The names of these groups in the order of help.
[[nodiscard]] const std::vector<std::string>& option_groups();

}  // namespace thermedge::cli
