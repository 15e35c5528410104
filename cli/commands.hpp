// One function per subcommand: adds it to the program; `exit_code` is set when it runs.
#pragma once

#include <CLI/CLI.hpp>

namespace thermedge::cli {

void add_detect(CLI::App& program, int& exit_code);
void add_track(CLI::App& program, int& exit_code);
void add_trace(CLI::App& program, int& exit_code);
void add_scale(CLI::App& program, int& exit_code);
void add_denoise(CLI::App& program, int& exit_code);
void add_stages(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_radiation(CLI::App& program, int& exit_code);
void add_snr(CLI::App& program, int& exit_code);
void add_bench(CLI::App& program, int& exit_code);
void add_probe(CLI::App& program, int& exit_code);
void add_simulate(CLI::App& program, int& exit_code);
void add_evaluate(CLI::App& program, int& exit_code);
void add_completion(CLI::App& program, int& exit_code);
void add_man(CLI::App& program, int& exit_code);

}  // namespace thermedge::cli
