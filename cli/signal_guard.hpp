// What Ctrl-C does to a run over many frames.
#pragma once

#include <string_view>

namespace thermedge::cli {

// While it lives, SIGINT, SIGTERM and SIGHUP end the program between two frames and never within
// one: at once where it waits for a frame, else as soon as the frame in work is done. The exit code
// is 128 plus the number of the signal, as shells have it. The same signal again ends the program
// where it stands. One guard at a time.
class SignalGuard {
 public:
  SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;
  ~SignalGuard();

  // Around all that writes results of a frame, which has left the program at the end.
  void begin_frame();
  void end_frame();
  // What a signal that comes before the next frame prints on standard error. Between begin_frame
  // and end_frame, or before the first.
  void set_last_words(std::string_view text);
};

}  // namespace thermedge::cli
