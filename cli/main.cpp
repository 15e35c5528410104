// The thermedge program: docs/architecture.md, layer cli
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "command_tree.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "help.hpp"
#include "standard_output.hpp"
#include "thermedge/simd.hpp"
#include "thermedge/similar_names.hpp"
#include "thermedge/version.hpp"

namespace thermedge::cli {
namespace {

constexpr const char* kVersionHelp = "print the version and exit";

class HelpFormatter final : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    return app->get_parent() == nullptr ? program_help(command_text(*app), commands_of(*app))
                                        : command_help(command_text(*app));
  }
};

std::vector<std::string> names_of_commands(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  return names;
}

std::string joined(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) {
    list += (list.empty() ? "" : ", ") + word;
  }
  return list;
}

void add_commands(CLI::App& program, int& exit_code) {
  add_detect(program, exit_code);
  add_track(program, exit_code);
  add_trace(program, exit_code);
  add_scale(program, exit_code);
  add_denoise(program, exit_code);
  add_stages(program, exit_code);
  add_compare(program, exit_code);
  add_radiation(program, exit_code);
  add_snr(program, exit_code);
  add_bench(program, exit_code);
  add_probe(program, exit_code);
  add_simulate(program, exit_code);
  add_evaluate(program, exit_code);
  add_completion(program, exit_code);
  add_man(program, exit_code);
}

// Help and version everywhere, and one look of them.
void complete(CLI::App& app, const std::shared_ptr<CLI::FormatterBase>& formatter,
              const std::string& version) {
  app.formatter(formatter);
  app.set_help_flag("-h,--help", "print this page and exit");
  app.set_version_flag("-V,--version", version, kVersionHelp);
  group_options(app);
}

// `help` and `help COMMAND` as --help says it.
std::vector<std::string> with_help_as_flag(std::vector<std::string> words) {
  if (!words.empty() && words[0] == "help") {
    words.erase(words.begin());
    words.resize(std::min<std::size_t>(words.size(), 1));
    words.emplace_back("--help");
  }
  return words;
}

// What is wrong with the first word; empty where it is a command or an option of the program.
std::string wrong_first_word(const CLI::App& program, const std::vector<std::string>& words) {
  const std::vector<std::string> commands = names_of_commands(program);
  if (words.empty()) {
    return "a command is missing; there are " + joined(commands);
  }
  const std::string& word = words[0];
  if (program.get_option_no_throw(word) != nullptr ||
      std::find(commands.begin(), commands.end(), word) != commands.end()) {
    return "";
  }
  std::vector<std::string> known = commands;
  known.emplace_back("help");
  const std::string meant = did_you_mean(word, known);
  return word + ": no such command" + (meant.empty() ? "; there are " + joined(commands) : meant);
}

// Names the first word that the command does not know, and what may have been meant.
std::string unexpected_word(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands()) {
    const std::vector<std::string> words = command->remaining();
    if (words.empty()) {
      continue;
    }
    std::vector<std::string> known;
    for (const OptionText& option : command_text(*command).options) {
      known.push_back(option.name);
    }
    const std::string word = words[0].substr(0, words[0].find('='));
    const std::string of_command = "; thermedge " + command->get_name() + " --help lists them";
    if (!word.starts_with("-")) {
      return words[0] + ": one word too many; usage: " + usage_of(command_text(*command));
    }
    const std::string meant = did_you_mean(word, known);
    return word + ": " + command->get_name() + " has no such option" +
           (meant.empty() ? of_command : meant);
  }
  return "";
}

// Messages quote the command line, which may hold anything.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char letter) { return letter < ' ' || letter == 127; },
      ' ');
  return text;
}

std::string message_of(const CLI::App& program, const CLI::ParseError& error) {
  const std::string unexpected =
      dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ? unexpected_word(program) : "";
  return unexpected.empty() ? std::string(error.what()) + "; --help lists what there is"
                            : unexpected;
}

int run(std::vector<std::string> words) {
  const bool json_log = std::find(words.begin(), words.end(), "--json-log") != words.end();
  const auto bad_usage = [&](const std::string& message) {
    Console(false, json_log).error(on_one_line(message));
    return kBadUsage;
  };
  CLI::App program{"thermedge finds the smooth, connected edges in noisy thermal-infrared frames.",
                   "thermedge"};
  program.require_subcommand(1);
  int exit_code = kGood;
  add_commands(program, exit_code);
  const auto formatter = std::make_shared<HelpFormatter>();
  const std::string version =
      std::string("thermedge ") + kVersion + " (" + SimdTarget().name() + ")";
  complete(program, formatter, version);
  for (CLI::App* command : program.get_subcommands({})) {
    complete(*command, formatter, version);
  }
  words = with_help_as_flag(std::move(words));
  if (const std::string wrong = wrong_first_word(program, words); !wrong.empty()) {
    return bad_usage(wrong);
  }
  std::reverse(words.begin(), words.end());  // as the parser wants them
  try {
    program.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    // Help and version are no errors; everything else is bad usage.
    return error.get_exit_code() == 0 ? (program.exit(error), kGood)
                                      : bad_usage(message_of(program, error));
  }
  return exit_code;
}

// The exit code of a run that ended with `exit_code`, less what it printed in vain.
int finish(int exit_code, int argc, char** argv) {
  const Status status = finish_standard_output();
  if (status) {
    return exit_code;
  }
  const bool json_log = std::any_of(
      argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json-log"; });
  return Console(false, json_log).fail(status.error());
}

}  // namespace
}  // namespace thermedge::cli

int main(int argc, char** argv) {
  int exit_code = thermedge::cli::kBadInput;
  try {
    exit_code = thermedge::cli::run({argv + std::min(argc, 1), argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "thermedge: error: %s\n", error.what());
  }
  return thermedge::cli::finish(exit_code, argc, argv);
}
