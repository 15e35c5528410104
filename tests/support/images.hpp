// Pictures for tests: seeded noise, comparison, guarded buffers, the shared recordings.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/simd.hpp"

namespace thermedge::test {

// Gaussian noise around `mean`, rounded and clipped for integer pixels.
template <class T>
Image<T> noise_image(int width, int height, double mean, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(mean, sigma);
  Image<T> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double value = normal(random);
      if constexpr (std::is_integral_v<T>) {
        value =
            std::clamp(std::round(value), 0.0, static_cast<double>(std::numeric_limits<T>::max()));
      }
      image(x, y) = static_cast<T>(value);
    }
  }
  return image;
}

// Compares bit by bit and names the first pixel that differs.
template <class T>
testing::AssertionResult same_pixels(ImageView<const T> a, ImageView<const T> b) {
  if (!same_size(a, b)) {
    return testing::AssertionFailure() << "sizes " << a.width() << "x" << a.height() << " and "
                                       << b.width() << "x" << b.height();
  }
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (!(a(x, y) == b(x, y))) {
        return testing::AssertionFailure()
               << "pixel (" << x << ", " << y << "): " << +a(x, y) << " and " << +b(x, y);
      }
    }
  }
  return testing::AssertionSuccess();
}

// An image inside a larger buffer full of a sentinel, so that a write outside is seen.
template <class T>
class GuardedImage {
 public:
  GuardedImage(int width, int height, T sentinel = T(77))
      : sentinel_(sentinel), buffer_(width + 2 * kMargin, height + 2 * kMargin) {
    fill_pixels(buffer_.view(), sentinel);
    view_ = buffer_.view().crop(kMargin, kMargin, width, height);
  }
  [[nodiscard]] ImageView<T> view() { return view_; }
  [[nodiscard]] bool intact() const {
    for (int y = 0; y < buffer_.height(); ++y) {
      for (int x = 0; x < buffer_.width(); ++x) {
        const bool inside = view_.contains(x - kMargin, y - kMargin);
        if (!inside && !(buffer_(x, y) == sentinel_)) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  static constexpr int kMargin = 70;
  T sentinel_;
  Image<T> buffer_;
  ImageView<T> view_;
};

// Calls `check(name)` once for each SIMD target of this machine, then returns to the best.
template <class F>
void for_each_simd_target(F&& check) {
  for (const std::string& target : simd_targets()) {
    const SimdScope scope(*SimdTarget::named(target));
    SCOPED_TRACE("SIMD target " + target);
    check(target);
  }
}

// The recordings beside the checkout (THERMEDGE_SHARED names another place); they are optional.
inline std::filesystem::path shared_directory() {
  const char* place = std::getenv("THERMEDGE_SHARED");
  return place != nullptr ? place : THERMEDGE_SHARED_DEFAULT;
}

// Skips the test, and says so, where a shared file or directory is absent.
#define THERMEDGE_NEEDS_SHARED(part)                                          \
  if (!std::filesystem::exists(thermedge::test::shared_directory() / (part))) \
  GTEST_SKIP() << "needs " << (thermedge::test::shared_directory() / (part)).string()

}  // namespace thermedge::test
