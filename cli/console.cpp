#include "console.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace thermedge::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kBarWidth = 30;
constexpr const char* kClearLine = "\r\033[K";

std::string counted(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string text_of(const Json& entry) {
  return entry.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Three digits tell all that is known of it.
std::string rate_text(double per_second) {
  return per_second < 9.995   ? fmt::format("{:.2f}", per_second)
         : per_second < 99.95 ? fmt::format("{:.1f}", per_second)
                              : fmt::format("{:.0f}", per_second);
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 9.95) {
    return fmt::format("{:.1f} s", seconds);
  }
  const auto whole = static_cast<long>(std::lround(seconds));
  return whole < 60     ? fmt::format("{} s", whole)
         : whole < 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                        : fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

Console::Console(bool quiet, bool json_log)
    : quiet_(quiet),
      json_(json_log),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

void Console::line(std::string_view level, std::string_view message) {
  clear_bar();
  if (json_) {
    fmt::print(stderr, "{}\n", text_of({{"level", level}, {"message", message}}));
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

double Console::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Console::progress(std::size_t done, std::size_t expected) {
  const double elapsed = seconds();
  if (quiet_ || json_ || !terminal_ || elapsed < 1) {
    return;
  }
  const double rate = static_cast<double>(done) / elapsed;
  std::string bar;
  if (expected == 0) {
    bar = counted(done, "frame");
  } else {
    const auto filled = static_cast<int>(kBarWidth * std::min(done, expected) / expected);
    bar = fmt::format("[{:#<{}}{: <{}}] {}/{}", "", filled, "", kBarWidth - filled, done, expected);
  }
  bar += fmt::format(", {} frames/s", rate_text(rate));
  if (done > 0 && expected > done) {
    bar += ", " + duration_text(static_cast<double>(expected - done) / rate) + " left";
  }
  // The rest of a longer bar before is cleared.
  fmt::print(stderr, "{}{}", kClearLine, bar);
  std::fflush(stderr);
  bar_shown_ = true;
  if (done == expected) {
    clear_bar();
  }
}

std::string Console::summary_text(std::size_t frames, std::size_t failures) const {
  std::string text = counted(frames, "frame") + ", ";
  text += failures == 0 ? "no failures" : counted(failures, "failure");
  if (edges_) {
    text += ", " + counted(*edges_, "edge");
  }
  text += fmt::format(", {} frames a second", rate_text(static_cast<double>(frames) / seconds()));
  return results_.empty() ? text : text + "; results: " + results_;
}

std::string Console::summary_json(std::string_view message, std::size_t frames,
                                  std::size_t failures) const {
  Json entry = {
      {"level", "info"}, {"message", message}, {"frames", frames}, {"failures", failures}};
  if (edges_) {
    entry["edges"] = *edges_;
  }
  const double rate = static_cast<double>(frames) / seconds();
  entry["frames_per_second"] = std::round(100 * rate) / 100;
  entry["results"] = results_;
  return text_of(entry);
}

void Console::summarize(std::size_t frames, std::size_t failures) {
  if (quiet_ || frames < 2 || results_.empty()) {
    return;
  }
  clear_bar();
  const std::string text = summary_text(frames, failures);
  fmt::print(stderr, "{}\n", json_ ? summary_json(text, frames, failures) : "thermedge: " + text);
}

std::string Console::interruption_line(std::size_t frames, std::size_t failures) const {
  if (quiet_) {
    return bar_shown_ ? kClearLine : "";
  }
  const std::string text = "interrupted after " + summary_text(frames, failures);
  return json_ ? summary_json(text, frames, failures) + "\n"
               : (terminal_ ? kClearLine : "") + ("thermedge: " + text) + "\n";
}

void Console::clear_bar() {
  if (bar_shown_) {
    fmt::print(stderr, "{}", kClearLine);
    bar_shown_ = false;
  }
}

}  // namespace thermedge::cli
