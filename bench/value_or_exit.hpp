// A benchmark that cannot go on says why and ends.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "thermedge/result.hpp"

namespace thermedge::bench {

[[noreturn]] inline void give_up(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);
}

template <class T>
T value_or_exit(Result<T> result) {
  if (!result) {
    give_up(result.error().message);
  }
  return std::move(*result);
}
inline void value_or_exit(const Status& status) {
  if (!status) {
    give_up(status.error().message);
  }
}

}  // namespace thermedge::bench
