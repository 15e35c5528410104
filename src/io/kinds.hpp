// Kinds of pictures, told apart by content.
#pragma once

#include <cstddef>
#include <span>

namespace thermedge::io {

enum class Kind { kUnknown, kPng, kTiff, kPgm, kNpy };

// By the first bytes; 16 are enough.
[[nodiscard]] Kind kind_of(std::span<const std::byte> first_bytes);

}  // namespace thermedge::io
