// Random scenes in the conditions in which users' frames come, with a truth in units of the noise.
#pragma once

#include <array>
#include <cstdint>

#include "test_frames.hpp"

namespace thermedge::bench {

// Contrasts in units of the noise at their place.
inline constexpr double kAskedSigmas = 1.5;      // recall asks for such edges
inline constexpr double kAcceptedSigmas = 0.25;  // precision accepts these

enum class Circumstance {
  kNone,
  kHotThings,     // one to three small things, 8 to 46 times the range hotter than the scene
  kWideRange,     // steps from .001 of the range on, slopes as gentle
  kBlackCorners,  // no picture there, as undistortion leaves them; no edge within 3 px of them
                  // counts
  kHalfPixel,     // moved by half a pixel in x and y by linear interpolation
  kUnevenNoise,   // from half the noise on the left to twice the noise on the right, no stripes
  kJpeg,          // 8 bits, through JPEG of quality 80
  kCoarseSteps,   // in steps of two sigma
};

struct SceneCondition {
  const char* name;
  Circumstance circumstance;
  double range_counts;
  double sigma_counts;
};

inline constexpr std::array kSceneConditions = {
    SceneCondition{"noise of 8", Circumstance::kNone, 130, 8},
    SceneCondition{"noise of 20", Circumstance::kNone, 130, 20},
    SceneCondition{"hot things, noise of 8", Circumstance::kHotThings, 130, 8},
    SceneCondition{"hot things, noise of 20", Circumstance::kHotThings, 130, 20},
    SceneCondition{"range of 1000, noise of 5", Circumstance::kWideRange, 1000, 5},
    SceneCondition{"range of 4000, noise of 8", Circumstance::kWideRange, 4000, 8},
    SceneCondition{"black corners", Circumstance::kBlackCorners, 130, 8},
    SceneCondition{"moved by half a pixel", Circumstance::kHalfPixel, 130, 8},
    SceneCondition{"noise from 4 to 16", Circumstance::kUnevenNoise, 130, 8},
    SceneCondition{"JPEG", Circumstance::kJpeg, 130, 8},
    SceneCondition{"steps of 16", Circumstance::kCoarseSteps, 130, 8}};

// Scene and noise have the seed; conditions with one circumstance have the same scenes. 382x288.
// Any thread.
[[nodiscard]] TestFrame scene_under(const SceneCondition& condition, std::uint64_t seed);

// Of the noise, in the unit of the pixels that scene_under() makes.
[[nodiscard]] double pixel_sigma(const SceneCondition& condition);

}  // namespace thermedge::bench
