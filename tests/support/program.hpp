// Runs the thermedge program as a user would.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/files.hpp"

namespace thermedge::test {

struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
};

// `arguments` as typed behind "thermedge" in a shell, in `directory`.
inline ProgramRun run_program(const std::string& arguments,
                              const std::filesystem::path& directory) {
  const auto out = directory / "stdout.txt";
  const auto err = directory / "stderr.txt";
  const std::string command = "cd '" + directory.string() + "' && '" + THERMEDGE_PROGRAM + "' " +
                              arguments + " >'" + out.string() + "' 2>'" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_text(out), file_text(err)};
}

inline std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace thermedge::test
