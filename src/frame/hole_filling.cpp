#include "thermedge/stages/hole_filling.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace thermedge {
namespace {

constexpr std::uint32_t kFull = 256;      // weight of a pixel that was measured as a whole
constexpr std::uint32_t kPerCount = 256;  // of the pyramid's values

int half_of(int length) { return (length + 1) / 2; }

// Up to three pixels of a finer row (or column) and how much each counts, in quarters.
struct Taps {
  int first;
  int count;
  std::array<std::uint32_t, 3> weights;
};

// What coarse pixel `i` is made of. Pairs where the length is even; where it is odd every other
// pixel with half of both its neighbours, of which those at the ends have one only.
Taps fine_pixels(int i, int length) {
  if (length == 1) {
    return {0, 1, {4, 0, 0}};
  }
  if (length % 2 == 0) {
    return {2 * i, 2, {2, 2, 0}};
  }
  if (i == 0) {
    return {0, 2, {2, 1, 0}};
  }
  return 2 * i == length - 1 ? Taps{2 * i - 1, 2, {1, 2, 0}} : Taps{2 * i - 1, 3, {1, 2, 1}};
}

// What fine pixel `i` is interpolated from, in quarters.
struct Between {
  int a, b;
  std::uint32_t weight_a, weight_b;
};

Between coarse_pixels(int i, int length) {
  const int j = i / 2;
  if (length % 2 == 0) {
    const int other = std::clamp(i % 2 == 0 ? j - 1 : j + 1, 0, length / 2 - 1);
    return {j, other, 3, 1};
  }
  return i % 2 == 0 ? Between{j, j, 2, 2} : Between{j, j + 1, 2, 2};
}

// Sums over the pixels that one coarse pixel is made of.
struct Sums {
  std::uint64_t values = 0;
  std::uint32_t weights = 0;
  std::uint32_t taps = 0;

  void add(std::uint32_t tap, std::uint32_t weight, std::uint32_t value) {
    values += std::uint64_t{tap * weight} * value;
    weights += tap * weight;
    taps += tap;
  }
  [[nodiscard]] std::uint32_t value() const {
    return weights == 0 ? 0 : static_cast<std::uint32_t>((values + weights / 2) / weights);
  }
  // Rounded up, so that what was measured at all stays known.
  [[nodiscard]] std::uint16_t weight() const {
    return static_cast<std::uint16_t>((weights + taps - 1) / taps);
  }
};

template <class F>
Sums add_up(const Taps& across, const Taps& down, F&& weight_and_value) {
  Sums sums;
  for (int v = 0; v < down.count; ++v) {
    for (int u = 0; u < across.count; ++u) {
      const auto [weight, value] = weight_and_value(across.first + u, down.first + v);
      sums.add(
          across.weights[static_cast<std::size_t>(u)] * down.weights[static_cast<std::size_t>(v)],
          weight, value);
    }
  }
  return sums;
}

std::uint32_t interpolate(ImageView<const std::uint32_t> coarse, const Between& across,
                          const Between& down) {
  const auto along = [&](int y) {
    const std::uint32_t* row = coarse.row(y);
    return std::uint64_t{across.weight_a} * row[across.a] +
           std::uint64_t{across.weight_b} * row[across.b];
  };
  return static_cast<std::uint32_t>(
      (down.weight_a * along(down.a) + down.weight_b * along(down.b) + 8) / 16);
}

struct WeightAndValue {
  std::uint32_t weight, value;
};

// The same as the general rule for four pixels, of which most have been measured.
void push_pairs(const std::uint16_t* upper, const std::uint16_t* lower,
                const std::uint8_t* upper_valid, const std::uint8_t* lower_valid, int width,
                std::uint32_t* values, std::uint16_t* weights) {
  for (int i = 0; i < width; ++i) {
    const int x = 2 * i;
    const std::uint32_t a = upper_valid[x] != 0 ? 1 : 0;
    const std::uint32_t b = upper_valid[x + 1] != 0 ? 1 : 0;
    const std::uint32_t c = lower_valid[x] != 0 ? 1 : 0;
    const std::uint32_t d = lower_valid[x + 1] != 0 ? 1 : 0;
    const std::uint32_t number = a + b + c + d;
    const std::uint32_t sum =
        kPerCount * (a * upper[x] + b * upper[x + 1] + c * lower[x] + d * lower[x + 1]);
    values[i] = number == 4 ? (sum + 2) / 4 : number == 0 ? 0 : (sum + number / 2) / number;
    weights[i] = static_cast<std::uint16_t>(number * kFull / 4);
  }
}

}  // namespace

void HoleFiller::prepare(int width, int height) {
  if (width == width_ && height == height_) {
    return;
  }
  width_ = width;
  height_ = height;
  std::size_t levels = 0;
  while (width > 1 || height > 1) {
    width = half_of(width);
    height = half_of(height);
    if (levels == levels_.size()) {
      levels_.emplace_back();
    }
    levels_[levels].values.resize(width, height);
    levels_[levels].weights.resize(width, height);
    ++levels;
  }
  levels_.resize(levels);
}

void HoleFiller::push_frame(ImageView<const std::uint16_t> counts,
                            ImageView<const std::uint8_t> valid) {
  Level& out = levels_.front();
  const bool pairs = counts.width() % 2 == 0 && counts.height() % 2 == 0;
  for (int y = 0; y < out.values.height(); ++y) {
    if (pairs) {
      push_pairs(counts.row(2 * y), counts.row(2 * y + 1), valid.row(2 * y), valid.row(2 * y + 1),
                 out.values.width(), out.values.row(y), out.weights.row(y));
      continue;
    }
    const Taps down = fine_pixels(y, counts.height());
    for (int x = 0; x < out.values.width(); ++x) {
      const Sums sums = add_up(fine_pixels(x, counts.width()), down, [&](int u, int v) {
        return WeightAndValue{valid(u, v) != 0 ? kFull : 0, kPerCount * counts(u, v)};
      });
      out.values(x, y) = sums.value();
      out.weights(x, y) = sums.weight();
    }
  }
}

void HoleFiller::push(int level) {
  const Level& in = levels_[static_cast<std::size_t>(level) - 1];
  Level& out = levels_[static_cast<std::size_t>(level)];
  for (int y = 0; y < out.values.height(); ++y) {
    const Taps down = fine_pixels(y, in.values.height());
    for (int x = 0; x < out.values.width(); ++x) {
      const Sums sums = add_up(fine_pixels(x, in.values.width()), down, [&](int u, int v) {
        return WeightAndValue{in.weights(u, v), in.values(u, v)};
      });
      out.values(x, y) = sums.value();
      out.weights(x, y) = sums.weight();
    }
  }
}

// What was not measured of the pixels of `level` comes from the one above it, which is full.
void HoleFiller::pull(int level) {
  const Level& coarse = levels_[static_cast<std::size_t>(level) + 1];
  Level& fine = levels_[static_cast<std::size_t>(level)];
  for (int y = 0; y < fine.values.height(); ++y) {
    const Between down = coarse_pixels(y, fine.values.height());
    for (int x = 0; x < fine.values.width(); ++x) {
      const std::uint32_t weight = fine.weights(x, y);
      if (weight < kFull) {
        const std::uint64_t rest =
            interpolate(coarse.values, coarse_pixels(x, fine.values.width()), down);
        fine.values(x, y) = static_cast<std::uint32_t>(
            (std::uint64_t{weight} * fine.values(x, y) + (kFull - weight) * rest + kFull / 2) /
            kFull);
      }
    }
  }
}

void HoleFiller::fill(ImageView<std::uint16_t> counts, ImageView<const std::uint8_t> valid) {
  assert(same_size(counts, valid));
  prepare(counts.width(), counts.height());
  if (levels_.empty()) {  // a single pixel
    if (!counts.empty() && valid(0, 0) == 0) {
      counts(0, 0) = 0;
    }
    return;
  }
  const int top = static_cast<int>(levels_.size()) - 1;
  push_frame(counts, valid);
  for (int level = 1; level <= top; ++level) {
    push(level);
  }
  for (int level = top - 1; level >= 0; --level) {
    pull(level);
  }
  const ImageView<const std::uint32_t> coarse = levels_.front().values;
  for (int y = 0; y < counts.height(); ++y) {
    const std::uint8_t* measured = valid.row(y);
    const auto width = static_cast<std::size_t>(counts.width());
    if (std::memchr(measured, 0, width) == nullptr) {
      continue;
    }
    const Between down = coarse_pixels(y, counts.height());
    for (int x = 0; x < counts.width(); ++x) {
      if (measured[x] == 0) {
        const std::uint32_t value =
            interpolate(coarse, coarse_pixels(x, counts.width()), down) + kPerCount / 2;
        counts(x, y) =
            static_cast<std::uint16_t>(std::min(value / kPerCount, std::uint32_t{65535}));
      }
    }
  }
}

}  // namespace thermedge
