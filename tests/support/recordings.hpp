// Simulated recordings with a planted sensor: what a probe has to find again.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "support/images.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::test {

// Calls `take(frame)` for the frames of a scene of the simulator, e.g. "sim:desk?frames=8&sigma=6".
template <class F>
void for_each_frame(const std::string& spec, F&& take) {
  auto renderer = sim::parse_scene(spec).and_then(sim::Renderer::create);
  ASSERT_TRUE(renderer) << renderer.error().message;
  const auto runner = make_runner(0);
  for (int i = 0; i < renderer->options().frames; ++i) {
    auto frame = renderer->render(i, *runner);
    ASSERT_TRUE(frame) << frame.error().message;
    take(std::move(*frame));
  }
}

inline std::vector<Image<std::uint16_t>> scene_frames(const std::string& spec) {
  std::vector<Image<std::uint16_t>> frames;
  for_each_frame(spec, [&](sim::TrueFrame frame) { frames.push_back(std::move(frame.counts)); });
  return frames;
}

// A moving scene without noise, to which `add_noise` adds what a sensor does.
inline std::vector<Image<float>> clean_frames(const std::string& spec) {
  std::vector<Image<float>> frames;
  for_each_frame(spec, [&](sim::TrueFrame frame) { frames.push_back(std::move(frame.clean)); });
  return frames;
}

// Per-pixel offsets of `pattern_sigma`, the same for every frame of one seed, and temporal noise of
// `sigma(x, y)`.
template <class F>
Image<std::uint16_t> add_noise(ImageView<const float> clean, F&& sigma, double pattern_sigma,
                               unsigned frame) {
  std::mt19937 fixed(99);
  std::mt19937 temporal(1000 + frame);
  std::normal_distribution<double> normal_fixed, normal;
  Image<std::uint16_t> counts(clean.width(), clean.height());
  for (int y = 0; y < clean.height(); ++y) {
    for (int x = 0; x < clean.width(); ++x) {
      const double value = static_cast<double>(clean(x, y)) + pattern_sigma * normal_fixed(fixed) +
                           sigma(x, y) * normal(temporal);
      counts(x, y) = static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 65535.0)));
    }
  }
  return counts;
}

}  // namespace thermedge::test
