// Frames that hold nothing but noise, in kinds that cameras and their users' software make.
#pragma once

#include <array>
#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::bench {

inline constexpr double kNoiseFrameSigma = 8;  // counts, of the noise that most of them start from

struct NoiseKind {
  const char* name;
  // Of 382x288; the same seed gives the same frame. Any thread.
  Image<std::uint16_t> (*make)(std::uint64_t seed);
};

namespace noise_frames {
[[nodiscard]] Image<std::uint16_t> white(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> moved_by_half_a_pixel(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> turned_by_half_a_degree(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> enlarged_twice(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> every_pixel_four_times(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> after_median(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> after_gaussian(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> after_jpeg(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> clipped(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> uneven(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> two_levels(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> photons(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> coarse_steps(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> below_a_count(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> fixed_pattern(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> stripes_of_one_sigma(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> stripes_of_three_sigma(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> heavy_tails(std::uint64_t seed);
[[nodiscard]] Image<std::uint16_t> dome_and_vignette(std::uint64_t seed);
}  // namespace noise_frames

inline constexpr std::array kNoiseKinds = {
    NoiseKind{"white, 8 counts", noise_frames::white},
    NoiseKind{"moved by half a pixel", noise_frames::moved_by_half_a_pixel},
    NoiseKind{"turned by half a degree", noise_frames::turned_by_half_a_degree},
    NoiseKind{"enlarged twice", noise_frames::enlarged_twice},
    NoiseKind{"every pixel four times", noise_frames::every_pixel_four_times},
    NoiseKind{"after a median of 3x3", noise_frames::after_median},
    NoiseKind{"after a Gaussian of 0.7 px", noise_frames::after_gaussian},
    NoiseKind{"JPEG of quality 80", noise_frames::after_jpeg},
    NoiseKind{"three quarters clipped", noise_frames::clipped},
    NoiseKind{"from 4 to 16 counts across the frame", noise_frames::uneven},
    NoiseKind{"4 counts in one half and 14 in the other", noise_frames::two_levels},
    NoiseKind{"of 4 to 400 photons", noise_frames::photons},
    NoiseKind{"in steps of two sigma", noise_frames::coarse_steps},
    NoiseKind{"0.3 counts on a slope, in whole counts", noise_frames::below_a_count},
    NoiseKind{"fixed pattern as strong as the noise", noise_frames::fixed_pattern},
    NoiseKind{"stripes of one sigma", noise_frames::stripes_of_one_sigma},
    NoiseKind{"stripes of three sigma", noise_frames::stripes_of_three_sigma},
    NoiseKind{"one pixel in 200 ten sigma off", noise_frames::heavy_tails},
    NoiseKind{"stripes, a dome of 40 sigma and a vignette", noise_frames::dome_and_vignette}};

}  // namespace thermedge::bench
