// `completion`: what the shells offer while a command line is typed, as scripts for them.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command_tree.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "standard_output.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/io/source_options.hpp"

namespace thermedge::cli {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> names_of(const CommandText& command) {
  std::vector<std::string> names;
  for (const OptionText& option : command.options) {
    names.push_back(option.name);
    if (!option.short_name.empty()) {
      names.push_back(option.short_name);
    }
  }
  return names;
}

std::vector<std::string> names_of(const std::vector<CommandText>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CommandText& command : commands) {
    names.push_back(command.name);
  }
  return names;
}

// Of --set, where it sets options of the detector.
bool takes_settings(const CommandText& command, const OptionText& option) {
  return option.name == "--set" && command.has_option("--config");
}

std::vector<std::string> names_of_settings() {
  std::vector<std::string> names = {"preset="};
  for (const io::OptionInfo& option : io::list_options()) {
    names.push_back(option.name + "=");
  }
  for (const std::string& name : io::source_option_names()) {
    names.push_back("source." + name + "=");
  }
  return names;
}

// Words that bash knows for the option in front of the cursor, and for settings of --set. In a
// command line "=" is a word of its own to bash.
std::string bash_cases(const std::vector<CommandText>& commands) {
  std::string cases;
  for (const CommandText& command : commands) {
    for (const OptionText& option : command.options) {
      const std::string names = fmt::format(
          "{0}:{1}{2}", command.name, option.name,
          option.short_name.empty() ? "" : "|" + command.name + ":" + option.short_name);
      if (!option.choices.empty()) {
        cases += fmt::format("    {}) words='{}' ;;\n", names, joined(option.choices));
      } else if (takes_settings(command, option)) {
        cases += fmt::format("    {}) words=$settings; compopt -o nospace 2>/dev/null ;;\n", names);
      } else if (option.takes_file) {
        cases += fmt::format("    {}) files=1 ;;\n", names);
      } else if (!option.argument.empty()) {
        cases += fmt::format("    {}) return ;;\n", names);
      }
    }
  }
  for (const io::OptionInfo& option : io::list_options()) {
    if (!option.choices.empty()) {
      cases += fmt::format("    *:{}) words='{}' ;;\n", option.name, joined(option.choices));
    }
  }
  return cases;
}

std::string bash_options(const std::vector<CommandText>& commands) {
  std::string cases;
  for (const CommandText& command : commands) {
    std::string words, files;
    for (const OptionText& argument : command.positionals) {
      words += joined(argument.choices);
      files = argument.takes_file ? "1" : files;
    }
    cases += fmt::format("    {}) options='{}' arguments='{}' inputs={} ;;\n", command.name,
                         joined(names_of(command)), words, files);
  }
  return cases;
}

std::string bash_script(const CommandText& program, const std::vector<CommandText>& commands) {
  return fmt::format(
      R"(# Completion of thermedge in bash; `thermedge completion bash` prints it.
_thermedge() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev= command=help i words= files=
  local options= arguments= inputs=
  local settings='{settings}'
  ((COMP_CWORD > 0)) && prev=${{COMP_WORDS[COMP_CWORD-1]}}
  if [[ $cur == '=' ]]; then
    cur=
  elif [[ $prev == '=' ]] && ((COMP_CWORD > 1)); then
    prev=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  COMPREPLY=()
  if ((COMP_CWORD > 1)); then
    command=${{COMP_WORDS[1]}}
  fi
  if ((COMP_CWORD == 1)) || [[ $command == help ]]; then
    COMPREPLY=($(compgen -W 'help {commands} {options}' -- "$cur"))
    return
  fi
  case $command:$prev in
{cases}  esac
  case $command in
{option_cases}  esac
  if [[ -z $words && -z $files && $cur == -* ]]; then
    words=$options
  elif [[ -z $words && -z $files ]]; then
    words=$arguments files=$inputs
  fi
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
  if [[ -n $files ]]; then
    local name
    while IFS= read -r name; do COMPREPLY+=("$name"); done < <(compgen -f -- "$cur")
    compopt -o filenames 2>/dev/null
  fi
}}
complete -F _thermedge thermedge
)",
      fmt::arg("settings", joined(names_of_settings())),
      fmt::arg("commands", joined(names_of(commands))),
      fmt::arg("options", joined(names_of(program))), fmt::arg("cases", bash_cases(commands)),
      fmt::arg("option_cases", bash_options(commands)));
}

std::string replaced(std::string text, std::string_view letters, std::string_view before) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (letters.find(text[i]) != std::string_view::npos) {
      text.insert(i, before);
      i += before.size();
    }
  }
  return text;
}

// Inside single quotes of zsh and fish.
std::string in_quotes(std::string text) {
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4) {
    text.replace(at, 1, "'\\''");
  }
  return text;
}

std::string zsh_meaning(const std::string& help) {
  return in_quotes(replaced(help, "[]:\\", "\\"));
}

std::string zsh_values(const CommandText& command, const OptionText& option) {
  if (!option.choices.empty() && option.takes_file) {
    return "{_files; compadd -- " + joined(option.choices) + "}";
  }
  if (!option.choices.empty()) {
    return "(" + joined(option.choices) + ")";
  }
  if (takes_settings(command, option)) {
    return "_thermedge_settings";
  }
  return option.takes_file ? "_files" : " ";
}

std::string zsh_option(const CommandText& command, const OptionText& option) {
  const std::string value =
      option.argument.empty() ? ""
                              : fmt::format(":{}:{}", option.argument, zsh_values(command, option));
  const std::string star = option.may_repeat ? "*" : "";
  std::string lines;
  for (const std::string& name : {option.short_name, option.name}) {
    if (!name.empty()) {
      lines +=
          fmt::format("        '{}{}[{}]{}' \\\n", star, name, zsh_meaning(option.help), value);
    }
  }
  return lines;
}

std::string zsh_script(const CommandText&, const std::vector<CommandText>& commands) {
  std::string names, cases;
  for (const CommandText& command : commands) {
    names += fmt::format("    '{}:{}'\n", command.name, in_quotes(command.description));
    cases += fmt::format("    {})\n      _arguments -s \\\n", command.name);
    for (const OptionText& option : command.options) {
      cases += zsh_option(command, option);
    }
    for (const OptionText& positional : command.positionals) {
      cases += fmt::format("        '{}:{}:{}' \\\n", positional.may_repeat ? "*" : "",
                           positional.name, zsh_values(command, positional));
    }
    cases += "        && return ;;\n";
  }
  return fmt::format(
      R"(#compdef thermedge
# Completion of thermedge in zsh; `thermedge completion zsh` prints it.
_thermedge_settings() {{
  compadd -S '' -- {settings}
}}
_thermedge() {{
  local -a commands=(
    'help:how a command is used'
{names}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
    help)
      _describe command commands ;;
{cases}  esac
}}
if [[ $funcstack[1] == _thermedge ]]; then
  _thermedge "$@"
else
  compdef _thermedge thermedge
fi
)",
      fmt::arg("settings", joined(names_of_settings())), fmt::arg("names", names),
      fmt::arg("cases", cases));
}

std::string fish_values(const CommandText& command, const OptionText& option) {
  if (!option.choices.empty()) {
    return fmt::format(" -x -a '{}'", joined(option.choices));
  }
  if (takes_settings(command, option)) {
    return fmt::format(" -x -a '{}'", joined(names_of_settings()));
  }
  return option.takes_file ? " -r -F" : option.argument.empty() ? "" : " -x";
}

std::string fish_script(const CommandText&, const std::vector<CommandText>& commands) {
  std::string text =
      "# Completion of thermedge in fish; `thermedge completion fish` prints it.\n"
      "complete -c thermedge -n __fish_use_subcommand -f -a help -d 'how a command is used'\n";
  for (const CommandText& command : commands) {
    text += fmt::format("complete -c thermedge -n __fish_use_subcommand -f -a {} -d '{}'\n",
                        command.name, in_quotes(command.description));
    for (const OptionText& option : command.options) {
      const std::string short_name =
          option.short_name.empty() ? "" : " -s " + option.short_name.substr(1);
      text += fmt::format(
          "complete -c thermedge -n '__fish_seen_subcommand_from {}'{} -l {}{} -d '{}'\n",
          command.name, short_name, option.name.substr(2), fish_values(command, option),
          in_quotes(option.help));
    }
    for (const OptionText& positional : command.positionals) {
      if (!positional.choices.empty()) {
        text += fmt::format("complete -c thermedge -n '__fish_seen_subcommand_from {}' -a '{}'\n",
                            command.name, joined(positional.choices));
      }
    }
  }
  return text +
         fmt::format("complete -c thermedge -n '__fish_seen_subcommand_from help' -f -a '{}'\n",
                     joined(names_of(commands)));
}

struct Shell {
  std::string_view name;
  std::string (*script)(const CommandText& program, const std::vector<CommandText>& commands);
};
constexpr std::array kShells = {Shell{"bash", bash_script}, Shell{"zsh", zsh_script},
                                Shell{"fish", fish_script}};

}  // namespace

void add_completion(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "completion", "print the script that completes commands and options in a shell");
  auto shell = std::make_shared<std::string>();
  std::vector<std::string> names;
  names.reserve(kShells.size());
  for (const Shell& known : kShells) {
    names.emplace_back(known.name);
  }
  app.add_option("SHELL", *shell, "the shell: bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember(names));
  app.callback([shell, &program, &exit_code] {
    const auto* known = std::find_if(kShells.begin(), kShells.end(),
                                     [&](const Shell& other) { return other.name == *shell; });
    print(known->script(command_text(program), commands_of(program)));
    exit_code = kGood;
  });
}

}  // namespace thermedge::cli
