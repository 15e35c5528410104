#include "signal_guard.hpp"

#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction is POSIX
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

namespace thermedge::cli {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

// Who may end the program: of the handler, which may run on any thread, and the thread of the
// frames, the one that brings the state from kWaiting to kEnding.
enum State : int { kWaiting, kInFrame, kEnding };
std::atomic<int> state{kWaiting};
std::atomic<int> pending_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "the handler uses them");

// Written in the state kInFrame only, read in the state kEnding only.
std::array<char, 1024> last_words;
std::size_t last_words_length = 0;

std::array<struct sigaction, kSignals.size()> previous_actions;

bool change_state(int from, int to) { return state.compare_exchange_strong(from, to); }

[[noreturn]] void end_program(int signal_number) {
  constexpr int kEndedBySignal = 128;
  // Nothing helps where standard error is closed.
  [[maybe_unused]] const ssize_t count =
      ::write(STDERR_FILENO, last_words.data(), last_words_length);
  ::_exit(kEndedBySignal + signal_number);
}

[[noreturn]] void wait_for_the_end() {
  for (;;) {
    ::pause();
  }
}

extern "C" void handle_signal(int signal_number) {
  pending_signal = signal_number;
  if (change_state(kWaiting, kEnding)) {
    end_program(signal_number);
  }
}

}  // namespace

SignalGuard::SignalGuard() {
  pending_signal = 0;
  last_words_length = 0;
  struct sigaction action {};
  action.sa_handler = handle_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &action, &previous_actions[i]);
    if (kSignals[i] == SIGHUP && previous_actions[i].sa_handler == SIG_IGN) {
      ::sigaction(SIGHUP, &previous_actions[i], nullptr);  // nohup
    }
  }
}

SignalGuard::~SignalGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &previous_actions[i], nullptr);
  }
}

void SignalGuard::begin_frame() {
  if (!change_state(kWaiting, kInFrame)) {
    wait_for_the_end();
  }
}

void SignalGuard::end_frame() {
  state = kWaiting;
  if (const int signal_number = pending_signal; signal_number != 0) {
    if (!change_state(kWaiting, kEnding)) {
      wait_for_the_end();
    }
    end_program(signal_number);
  }
}

void SignalGuard::set_last_words(std::string_view text) {
  last_words_length = std::min(text.size(), last_words.size());
  std::copy_n(text.begin(), last_words_length, last_words.begin());
}

}  // namespace thermedge::cli
