// `man`: the manual pages, made from the commands and their options.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "command_tree.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "help.hpp"
#include "standard_output.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/presets.hpp"
#include "thermedge/version.hpp"

namespace thermedge::cli {
namespace {

// Text as roff prints it: "-" as a minus that can be copied, nothing at the beginning of a line
// that is taken for a request.
std::string roff(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    escaped += letter == '-' ? "\\-" : letter == '\\' ? "\\e" : std::string(1, letter);
  }
  return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string title(const std::string& page) {
  std::string upper = page;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return fmt::format(".TH {} 1 \"\" \"thermedge {}\" \"User Commands\"\n", roff(upper), kVersion);
}

std::string section(std::string_view name) { return fmt::format(".SH {}\n", name); }

std::string entry(std::string_view label, std::string_view meaning) {
  return fmt::format(".TP\n.B {}\n{}\n", roff(label), roff(meaning));
}

std::string examples(const std::vector<Example>& list) {
  std::string text = section("EXAMPLES");
  for (const Example& example : list) {
    text += fmt::format("{}:\n.PP\n.RS 4\n.nf\n{}\n.fi\n.RE\n.PP\n", roff(example.meaning),
                        roff(example.command_line));
  }
  return text;
}

std::string exit_status() {
  std::string text = section("EXIT STATUS");
  for (const ExitCode& code : exit_codes()) {
    text += entry(std::to_string(code.code), code.meaning);
  }
  return text;
}

std::string page_of(const CommandText& command) {
  const std::string page = "thermedge-" + command.name;
  std::string text = title(page) + section("NAME") +
                     fmt::format("{} \\- {}\n", roff(page), roff(command.description)) +
                     section("SYNOPSIS") + roff(usage_of(command)) + "\n";
  text += command.positionals.empty() ? "" : section("ARGUMENTS");
  for (const OptionText& positional : command.positionals) {
    text += entry(positional.name, full_help(positional));
  }
  text += section("OPTIONS");
  for (const std::string& group : option_groups()) {
    std::string entries;
    for (const OptionText& option : command.options) {
      entries += option.group == group ? entry(names_and_argument(option), full_help(option)) : "";
    }
    text += entries.empty() ? "" : fmt::format(".SS {}\n{}", group, entries);
  }
  if (command.has_option("--preset")) {
    text += section("PRESETS");
    for (const auto& [preset, name] : kPresets) {
      text += entry(name, preset_meaning(preset));
    }
    text += command.has_option("--config") ? fmt::format(".PP\n{}\n", roff(kPrecedence)) : "";
  }
  return text + exit_status() + examples(examples_of(command.name)) + section("SEE ALSO") +
         ".BR thermedge (1)\n";
}

std::string page_of(const CommandText& program, const std::vector<CommandText>& commands) {
  std::string text = title("thermedge") + section("NAME") +
                     "thermedge \\- edges in noisy thermal\\-infrared frames\n" +
                     section("SYNOPSIS") + "thermedge COMMAND [OPTIONS] ...\n" +
                     section("DESCRIPTION") + roff(program.description) + "\n" +
                     section("COMMANDS");
  std::string others;
  for (const CommandText& command : commands) {
    text += entry(command.name, command.description);
    others += fmt::format("{}.BR thermedge\\-{} (1)", others.empty() ? "" : ",\n", command.name);
  }
  text += section("OPTIONS");
  for (const OptionText& option : program.options) {
    text += entry(names_and_argument(option), full_help(option));
  }
  return text + exit_status() +
         examples({examples_of("detect").front(), examples_of("probe").front()}) +
         section("SEE ALSO") + others + "\n";
}

struct ManCommand {
  std::string command;
  std::string output;

  [[nodiscard]] int run(const CLI::App& program) const;
  [[nodiscard]] Status write_all(const CLI::App& program) const;
};

Status ManCommand::write_all(const CLI::App& program) const {
  OutputDirectory directory(output);
  const auto write = [&](const std::string& name, const std::string& page) {
    directory.begin_frame(name);
    return directory.path("", ".1").and_then(
        [&](const std::string& file) { return io::write_file(file, page); });
  };
  const std::vector<CommandText> commands = commands_of(program);
  Status status = write("thermedge", page_of(command_text(program), commands));
  for (const CommandText& text : commands) {
    status = status.and_then([&] { return write("thermedge-" + text.name, page_of(text)); });
  }
  return status;
}

int ManCommand::run(const CLI::App& program) const {
  Console console(false, false);
  if (!output.empty()) {
    const Status status = write_all(program);
    return status ? kGood : console.fail(status.error());
  }
  const std::vector<CommandText> commands = commands_of(program);
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const CommandText& text) { return text.name == command; });
  print(found == commands.end() ? page_of(command_text(program), commands) : page_of(*found));
  return kGood;
}

}  // namespace

void add_man(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand("man", "print the manual page of a command");
  auto command = std::make_shared<ManCommand>();
  std::vector<std::string> names;
  for (const CLI::App* other : program.get_subcommands({})) {
    names.push_back(other->get_name());
  }
  app.add_option("COMMAND", command->command, "whose page; without: that of the program")
      ->check(CLI::IsMember(names));
  app.add_option("-o,--output", command->output, "directory that all pages are written to instead");
  app.callback([command, &program, &exit_code] { exit_code = command->run(program); });
}

}  // namespace thermedge::cli
