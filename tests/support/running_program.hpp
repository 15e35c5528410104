// The program while it runs: its standard input and output are pipes, and it takes signals.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "support/files.hpp"

namespace thermedge::test {

class RunningProgram {
 public:
  // `words`: of the command line, as they are, without a shell. Runs in `directory`; standard error
  // goes into the file stderr.txt there.
  RunningProgram(std::vector<std::string> words, const std::filesystem::path& directory)
      : errors_(directory / "stderr.txt") {
    std::array<int, 2> in{};
    std::array<int, 2> out{};
    EXPECT_EQ(::pipe2(in.data(), O_CLOEXEC), 0);
    EXPECT_EQ(::pipe2(out.data(), O_CLOEXEC), 0);
    words.insert(words.begin(), THERMEDGE_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) {
      const int errors = ::open(errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      if (::dup2(in[0], STDIN_FILENO) >= 0 && ::dup2(out[1], STDOUT_FILENO) >= 0 &&
          ::dup2(errors, STDERR_FILENO) >= 0 && ::chdir(directory.c_str()) == 0) {
        ::execv(THERMEDGE_PROGRAM, arguments.data());
      }
      ::_exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    input_ = in[1];
    output_ = out[0];
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram() {
    close_input();
    ::close(output_);
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
    }
  }

  void feed(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(input_, bytes.data(), bytes.size());
      ASSERT_GT(count, 0);
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  void close_input() {
    if (input_ >= 0) {
      ::close(input_);
      input_ = -1;
    }
  }
  // The next line of standard output without its end; what came of it where nothing more comes
  // within 10 s, or at the end.
  [[nodiscard]] std::string line() const {
    constexpr int kWaitMs = 10000;
    std::string text;
    pollfd ready{output_, POLLIN, 0};
    for (char c = 0; ::poll(&ready, 1, kWaitMs) == 1 && ::read(output_, &c, 1) == 1 && c != '\n';) {
      text += c;
    }
    return text;
  }
  void send(int signal_number) const { EXPECT_EQ(::kill(process_, signal_number), 0); }
  [[nodiscard]] bool is_running() {
    siginfo_t ended{};
    return ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           ended.si_pid == 0;
  }
  // Waits for the end. The exit code; -1 where a signal killed it.
  [[nodiscard]] int exit_code() {
    int status = 0;
    EXPECT_EQ(::waitpid(process_, &status, 0), process_);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string errors() const { return file_text(errors_); }

 private:
  std::filesystem::path errors_;
  pid_t process_ = -1;
  int input_ = -1;
  int output_ = -1;
};

}  // namespace thermedge::test
