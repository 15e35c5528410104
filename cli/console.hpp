// Messages of the program while it works: errors, notes and progress, on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "thermedge/result.hpp"

namespace thermedge::cli {

// Exit codes of the program.
inline constexpr int kGood = 0;
inline constexpr int kBadInput = 1;
inline constexpr int kBadUsage = 2;

class Console {
 public:
  Console(bool quiet, bool json_log);

  // One line each; errors are counted. Warnings and notes are left out by --quiet.
  void error(std::string_view message);
  void warn(std::string_view message);
  void note(std::string_view message);

  // Reports what keeps a command from starting; returns its exit code.
  [[nodiscard]] int fail(const Error& error);

  // A progress bar on a terminal, once the work has lasted a second. `expected` 0: not known.
  void progress(std::size_t done, std::size_t expected);

  [[nodiscard]] int exit_code() const { return errors_ > 0 ? kBadInput : kGood; }

 private:
  void line(std::string_view level, std::string_view message);
  void clear_bar();

  bool quiet_;
  bool json_;
  bool terminal_;
  bool bar_shown_ = false;
  std::size_t errors_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace thermedge::cli
