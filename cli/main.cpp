#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "commands.hpp"
#include "console.hpp"
#include "standard_output.hpp"
#include "thermedge/simd.hpp"
#include "thermedge/version.hpp"

namespace thermedge::cli {
namespace {

// The first word, where it is neither a command nor an option of the program itself: the parser
// would say no more than that a command is missing.
std::string unknown_word(const CLI::App& program, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  const bool known =
      word.empty() || program.get_option_no_throw(word) != nullptr ||
      !program.get_subcommands([&](const CLI::App* command) { return command->get_name() == word; })
           .empty();
  return known ? "" : word;
}

std::string names_of_commands(const CLI::App& program) {
  std::string names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  return names;
}

int run(int argc, char** argv) {
  CLI::App program{"thermedge finds the smooth, connected edges in noisy thermal-infrared frames."};
  program.set_version_flag("--version",
                           std::string("thermedge ") + kVersion + " (" + SimdTarget().name() + ")");
  program.require_subcommand(1);
  program.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("thermedge: error: ") + error.what() + " (--help shows what there is)\n";
  });
  int exit_code = kGood;
  add_detect(program, exit_code);
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
  if (const std::string word = unknown_word(program, argc, argv); !word.empty()) {
    std::fprintf(stderr, "thermedge: error: %s: no such command; there are %s\n", word.c_str(),
                 names_of_commands(program).c_str());
    return kBadUsage;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are no errors; everything else is bad usage.
    return program.exit(error) == 0 ? kGood : kBadUsage;
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
    exit_code = thermedge::cli::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "thermedge: error: %s\n", error.what());
  }
  return thermedge::cli::finish(exit_code, argc, argv);
}
