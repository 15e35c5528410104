#include "noise_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "portable.hpp"
#include "processing.hpp"
#include "random.hpp"
#include "test_frames.hpp"

namespace thermedge::bench::noise_frames {
namespace {

constexpr int kWidth = 382;
constexpr int kHeight = 288;
constexpr auto kMiddle = static_cast<float>(kMiddleCounts);
constexpr double kSigma = kNoiseFrameSigma;
// Streams of random numbers: those of pixels, columns and rows.
constexpr std::uint64_t kPixels = 0x401;
constexpr std::uint64_t kColumns = 0x402;
constexpr std::uint64_t kRows = 0x403;

// White noise; `sigma_at(x)` may differ by column.
template <class F>
Image<float> noise_of(int width, int height, F&& sigma_at, std::uint64_t seed) {
  const sim::Random random(seed, kPixels);
  Image<float> image(width, height);
  std::uint64_t index = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = static_cast<float>(kMiddleCounts + sigma_at(x) * random.normal(index++));
    }
  }
  return image;
}

Image<float> noise_of(double sigma, std::uint64_t seed, int width = kWidth, int height = kHeight) {
  return noise_of(
      width, height, [&](int) { return sigma; }, seed);
}

template <class F>
Image<float> changed(Image<float> image, F&& value) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      image(x, y) = static_cast<float>(value(image(x, y), x, y));
    }
  }
  return image;
}

Image<float> with_stripes(Image<float> image, double columns_sigma, double rows_sigma,
                          std::uint64_t seed) {
  const sim::Random columns(seed, kColumns);
  const sim::Random rows(seed, kRows);
  return changed(std::move(image), [&](double value, int x, int y) {
    return value + columns_sigma * columns.normal(static_cast<std::uint64_t>(x)) +
           rows_sigma * rows.normal(static_cast<std::uint64_t>(y));
  });
}

// Exponentially distributed waits of mean 1 / mean until their sum exceeds 1.
int photons_of(double mean, Draws& draws) {
  int count = -1;
  for (double sum = 0; sum < mean; ++count) {
    sum -= sim::exact_log(draws.uniform(0, 1));
  }
  return count;
}

// -1 at one border, 1 at the other.
double across(int place, int size) { return 2.0 * place / (size - 1) - 1; }

}  // namespace

Image<std::uint16_t> white(std::uint64_t seed) { return rounded(noise_of(kSigma, seed)); }

Image<std::uint16_t> moved_by_half_a_pixel(std::uint64_t seed) {
  return rounded(moved_by_half(noise_of(kSigma, seed)));
}

Image<std::uint16_t> turned_by_half_a_degree(std::uint64_t seed) {
  return rounded(turned(noise_of(kSigma, seed), sim::radians(0.5)));
}

Image<std::uint16_t> enlarged_twice(std::uint64_t seed) {
  return rounded(enlarged(noise_of(kSigma, seed, kWidth / 2, kHeight / 2)));
}

Image<std::uint16_t> every_pixel_four_times(std::uint64_t seed) {
  return rounded(repeated(noise_of(kSigma, seed, kWidth / 2, kHeight / 2)));
}

Image<std::uint16_t> after_median(std::uint64_t seed) {
  return rounded(median_of_9(noise_of(kSigma, seed)));
}

Image<std::uint16_t> after_gaussian(std::uint64_t seed) {
  return rounded(blurred(noise_of(kSigma, seed), 0.7));
}

// Stretched to 8 bits: 2.3 sigma to each side of the middle.
Image<std::uint16_t> after_jpeg(std::uint64_t seed) {
  return rounded(through_jpeg(changed(noise_of(kSigma, seed),
                                      [](double value, int, int) {
                                        return 127.5 + (value - kMiddle) * 127.5 / (2.3 * kSigma);
                                      }),
                              80));
}

Image<std::uint16_t> clipped(std::uint64_t seed) {
  constexpr double kLowerQuartile = -0.6745;  // of a normal variable
  return rounded(changed(noise_of(kSigma, seed), [](double value, int, int) {
    return std::min(value, kMiddle + kLowerQuartile * kSigma);
  }));
}

Image<std::uint16_t> uneven(std::uint64_t seed) {
  return rounded(noise_of(
      kWidth, kHeight, [](int x) { return kSigma * uneven_noise(x, kWidth); }, seed));
}

Image<std::uint16_t> two_levels(std::uint64_t seed) {
  return rounded(noise_of(
      kWidth, kHeight, [](int x) { return x < kWidth / 2 ? 4.0 : 14.0; }, seed));
}

Image<std::uint16_t> photons(std::uint64_t seed) {
  Draws draws(seed, kPixels);
  Image<float> image(kWidth, kHeight);
  return rounded(changed(std::move(image), [&](double, int x, int) {
    return photons_of(4 * std::pow(100, x / (kWidth - 1.0)), draws);
  }));
}

Image<std::uint16_t> coarse_steps(std::uint64_t seed) {
  return rounded(in_steps(noise_of(kSigma, seed), 2 * kSigma));
}

Image<std::uint16_t> below_a_count(std::uint64_t seed) {
  return rounded(changed(noise_of(0.3, seed),
                         [](double value, int x, int) { return value + 6 * across(x, kWidth); }));
}

// That of one camera, correlated over a pixel: half of the variance is noise.
Image<std::uint16_t> fixed_pattern(std::uint64_t seed) {
  constexpr std::uint64_t kCamera = 77;
  const Image<float> pattern = blurred(noise_of(kSigma, kCamera), 0.7);
  return rounded(changed(noise_of(kSigma / 2, seed), [&](double value, int x, int y) {
    return value + pattern(x, y) - kMiddle;
  }));
}

Image<std::uint16_t> stripes_of_one_sigma(std::uint64_t seed) {
  return rounded(with_stripes(noise_of(kSigma, seed), kSigma, kSigma / 1.3, seed));
}

Image<std::uint16_t> stripes_of_three_sigma(std::uint64_t seed) {
  return rounded(with_stripes(noise_of(kSigma, seed), 3 * kSigma, 3 * kSigma / 1.3, seed));
}

Image<std::uint16_t> heavy_tails(std::uint64_t seed) {
  Draws draws(seed, kColumns);
  return rounded(changed(noise_of(kSigma, seed), [&](double value, int, int) {
    const double place = draws.uniform(0, 1);
    return value + (place < 0.0025 ? -10 : place < 0.005 ? 10 : 0) * kSigma;
  }));
}

Image<std::uint16_t> dome_and_vignette(std::uint64_t seed) {
  return rounded(changed(with_stripes(noise_of(kSigma, seed), kSigma / 3, kSigma / 4, seed),
                         [](double value, int x, int y) {
                           const double u = across(x, kWidth);
                           const double v = across(y, kHeight);
                           const double r = u * u + v * v;
                           return value + kSigma * (40 * std::exp(-r) - 2.5 * r);
                         }));
}

}  // namespace thermedge::bench::noise_frames
