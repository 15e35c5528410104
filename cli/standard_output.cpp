#include "standard_output.hpp"

#include <cerrno>
#include <cstdio>
#include <iostream>

#include "thermedge/io/files.hpp"

namespace thermedge::cli {
namespace {

bool has_failed = false;
int reason = 0;  // a value of errno; 0: not known

void note_failure(bool failed) {
  if (failed && !has_failed) {
    has_failed = true;
    reason = errno;
  }
}

}  // namespace

void print(std::string_view text) {
  if (!has_failed) {
    errno = 0;
    note_failure(std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
                 std::fflush(stdout) != 0);
  }
}

bool standard_output_failed() { return has_failed; }

Status finish_standard_output() {
  errno = 0;
  std::cout.flush();
  note_failure(std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout.good());
  if (!has_failed) {
    return {};
  }
  return failure(ErrorCode::kIo, "standard output: cannot be written" +
                                     (reason != 0 ? ": " + io::reason_of(reason) : ""));
}

}  // namespace thermedge::cli
