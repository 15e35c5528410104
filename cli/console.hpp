// Messages of the program while it works: errors, notes, progress and the summary of a run, on
// standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "thermedge/result.hpp"

namespace thermedge::cli {

// Exit codes of the program. A run that a signal ended has 128 plus the signal's number.
inline constexpr int kGood = 0;
inline constexpr int kBadInput = 1;
inline constexpr int kBadUsage = 2;

// "1.5 s", "2 min 05 s", "3 h 07 min".
[[nodiscard]] std::string duration_text(double seconds);

class Console {
 public:
  Console(bool quiet, bool json_log);

  // One line each; errors are counted. Warnings and notes are left out by --quiet.
  void error(std::string_view message);
  void warn(std::string_view message);
  void note(std::string_view message);

  // Reports what keeps a command from starting; returns its exit code.
  [[nodiscard]] int fail(const Error& error);

  // A progress bar on a terminal, once the work has lasted a second, with rate and time left.
  // `expected` 0: not known.
  void progress(std::size_t done, std::size_t expected);

  // For the summary: where results go ("out/mask"), and edges that were found in one more frame.
  void set_results(std::string place) { results_ = std::move(place); }
  void add_edges(std::size_t edges) { edges_ = edges_.value_or(0) + edges; }

  // One line about a run over `frames` frames, `failures` of which failed: these numbers, edges
  // where they were counted, frames a second, and where the results are. Nothing where there was
  // one frame only, or where no results were set.
  void summarize(std::size_t frames, std::size_t failures);
  // The line that tells how far a run came that is interrupted now, with all that makes it one.
  [[nodiscard]] std::string interruption_line(std::size_t frames, std::size_t failures) const;

  // For results that are streams: a failure leaves a gap in them, so it ends the run. Returns
  // `status`.
  [[nodiscard]] Status or_end_run(Status status) {
    run_ended_ = run_ended_ || !status;
    return status;
  }
  [[nodiscard]] bool run_ended() const { return run_ended_; }

  [[nodiscard]] int exit_code() const { return errors_ > 0 ? kBadInput : kGood; }

 private:
  [[nodiscard]] double seconds() const;
  [[nodiscard]] std::string summary_text(std::size_t frames, std::size_t failures) const;
  // A line with the fields of the summary, for --json-log.
  [[nodiscard]] std::string summary_json(std::string_view message, std::size_t frames,
                                         std::size_t failures) const;
  void line(std::string_view level, std::string_view message);
  void clear_bar();

  bool quiet_;
  bool json_;
  bool terminal_;
  bool bar_shown_ = false;
  bool run_ended_ = false;
  std::size_t errors_ = 0;
  std::optional<std::size_t> edges_;
  std::string results_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace thermedge::cli
