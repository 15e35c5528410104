#include "console.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace thermedge::cli {
namespace {

constexpr int kBarWidth = 30;

}  // namespace

Console::Console(bool quiet, bool json_log)
    : quiet_(quiet),
      json_(json_log),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

void Console::line(std::string_view level, std::string_view message) {
  clear_bar();
  if (json_) {
    const nlohmann::ordered_json entry = {{"level", level}, {"message", message}};
    fmt::print(stderr, "{}\n",
               entry.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else {
    fmt::print(stderr, "thermedge: {}{}\n", level == "info" ? "" : fmt::format("{}: ", level),
               message);
  }
}

void Console::error(std::string_view message) {
  ++errors_;
  line("error", message);
}

void Console::warn(std::string_view message) {
  if (!quiet_) {
    line("warning", message);
  }
}

int Console::fail(const Error& failure) {
  error(failure.message);
  return failure.code == ErrorCode::kInvalidArgument ? kBadUsage : kBadInput;
}

void Console::note(std::string_view message) {
  if (!quiet_) {
    line("info", message);
  }
}

void Console::progress(std::size_t done, std::size_t expected) {
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  if (quiet_ || json_ || !terminal_ || elapsed < std::chrono::seconds(1)) {
    return;
  }
  if (expected == 0) {
    fmt::print(stderr, "\r{} frames", done);
  } else {
    const auto filled = static_cast<int>(kBarWidth * std::min(done, expected) / expected);
    fmt::print(stderr, "\r[{:#<{}}{: <{}}] {}/{}", "", filled, "", kBarWidth - filled, done,
               expected);
  }
  std::fflush(stderr);
  bar_shown_ = true;
  if (done == expected) {
    clear_bar();
  }
}

void Console::clear_bar() {
  if (bar_shown_) {
    fmt::print(stderr, "\r\033[K");
    bar_shown_ = false;
  }
}

}  // namespace thermedge::cli
