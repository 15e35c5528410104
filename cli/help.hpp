// What `--help` and the manual pages say besides the options.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "command_tree.hpp"

namespace thermedge::cli {

struct Example {
  std::string_view command_line;
  std::string_view meaning;
};

// Two for each command; none of an unknown one.
[[nodiscard]] std::vector<Example> examples_of(const std::string& command);

// "N; 0 to 1024; default 0" behind the meaning of an option.
[[nodiscard]] std::string full_help(const OptionText& option);
// "-o, --output FILE".
[[nodiscard]] std::string names_and_argument(const OptionText& option);
// "thermedge detect [OPTIONS] INPUT...".
[[nodiscard]] std::string usage_of(const CommandText& command);

struct ExitCode {
  int code;
  std::string_view meaning;
};
[[nodiscard]] const std::vector<ExitCode>& exit_codes();

// One paragraph: which value of an option wins.
inline constexpr std::string_view kPrecedence =
    "The preset comes from --preset, else from --set preset=NAME, else from the file of --config. "
    "Over it go the other values of the file, then --set, then the options of the command line; of "
    "several --set for one option the last wins.";

// The page of --help, at most 100 columns wide.
[[nodiscard]] std::string command_help(const CommandText& command);
[[nodiscard]] std::string program_help(const CommandText& program,
                                       const std::vector<CommandText>& commands);

}  // namespace thermedge::cli
