// Kinds of pictures, told apart by content.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "thermedge/result.hpp"

namespace thermedge::io {

enum class FileFormat { kUnknown, kPng, kTiff, kPgm, kNpy, kFff, kJpeg };

// By the first bytes; 16 are enough.
[[nodiscard]] FileFormat format_of(std::span<const std::byte> first_bytes);

// Says that a file of unknown kind is not read, what it seems to be, and what would help.
[[nodiscard]] Error unknown_format(std::span<const std::byte> first_bytes, const std::string& name);

}  // namespace thermedge::io
