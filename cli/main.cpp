#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include "report.hpp"
#include "thermedge/simd.hpp"

int main(int argc, char** argv) {
  namespace cli = thermedge::cli;
  CLI::App program{"thermedge finds the smooth, connected edges in noisy thermal-infrared frames."};
  program.set_version_flag("--version",
                           "thermedge " THERMEDGE_VERSION " (" + thermedge::simd_target() + ")");
  program.require_subcommand(1);
  int exit_code = cli::kGood;
  cli::add_detect(program, exit_code);
  cli::add_trace(program, exit_code);
  cli::add_scale(program, exit_code);
  cli::add_denoise(program, exit_code);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are no errors; everything else is bad usage.
    return program.exit(error) == 0 ? cli::kGood : cli::kBadUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "thermedge: error: %s\n", error.what());
    return cli::kBadInput;
  }
  return exit_code;
}
