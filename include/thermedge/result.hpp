// How the library reports failure: a value or an Error, never an exception, never a print.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace thermedge {

enum class ErrorCode {
  kInvalidArgument,  // an option or argument is out of range
  kIo,               // a file cannot be opened, read or written
  kBadData,          // a file is damaged or not what it claims to be
  kUnsupported,      // well-formed, but of a kind this library does not read
  kLimitExceeded,    // larger than Limits allow
  kOutOfMemory,
  kCancelled,  // the caller asked for it
};

// `message` is one line that names the file or option, what is wrong, and what would be right.
struct Error {
  Error() = default;
  Error(ErrorCode error_code, std::string text, std::string option_name = {})
      : code(error_code), message(std::move(text)), option(std::move(option_name)) {}

  ErrorCode code = ErrorCode::kInvalidArgument;
  std::string message;
  std::string option;  // full name of the option that is at fault, where one is
};

template <class T>
using Result = tl::expected<T, Error>;
using Status = tl::expected<void, Error>;

[[nodiscard]] inline tl::unexpected<Error> failure(ErrorCode code, std::string message,
                                                   std::string option = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(option)});
}

}  // namespace thermedge
