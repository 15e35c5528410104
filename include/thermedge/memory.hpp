// How much memory an object holds.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

template <class T>
concept ReportsMemory = requires(const T& object) {
  object.memory_bytes();
};

template <class T>
[[nodiscard]] std::size_t memory_of_one(const Image<T>& image) {
  return image.capacity_bytes();
}

template <ReportsMemory T>
[[nodiscard]] std::size_t memory_of_one(const T& object) {
  return object.memory_bytes();
}

template <class T>
[[nodiscard]] std::size_t memory_of_one(const std::vector<T>& values) {
  std::size_t bytes = values.capacity() * sizeof(T);
  if constexpr (!std::is_trivially_copyable_v<T>) {
    for (const T& value : values) {
      bytes += memory_of_one(value);
    }
  }
  return bytes;
}

// What the given images, vectors and objects that have memory_bytes() hold on the heap, bytes.
template <class... Ts>
[[nodiscard]] std::size_t memory_of(const Ts&... parts) {
  return (std::size_t{0} + ... + memory_of_one(parts));
}

}  // namespace thermedge::detail
