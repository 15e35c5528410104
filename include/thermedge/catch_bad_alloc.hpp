// The border between code that may throw and an interface that does not.
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "thermedge/result.hpp"

namespace thermedge::io {

// Calls `work`, which gives a Result or a Status; running out of memory becomes an error that names
// the file.
template <class F>
[[nodiscard]] auto catch_bad_alloc(const std::string& name, F&& work) -> decltype(work()) {
  try {
    return std::forward<F>(work)();
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, name + ": out of memory");
  } catch (const std::length_error&) {
    return failure(ErrorCode::kOutOfMemory, name + ": out of memory");
  }
}

}  // namespace thermedge::io
