// Edges of a mirrored or turned frame are the mirrored or turned edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/images.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

using Counts = Image<std::uint16_t>;
using Mask = Image<std::uint8_t>;

// One of the eight symmetries of a rectangle: a transposition, then mirrors.
struct Symmetry {
  bool transposed;
  bool mirrored_x;
  bool mirrored_y;

  // Where pixel (x, y) of a transformed frame of this size comes from.
  [[nodiscard]] std::pair<int, int> source(int x, int y, int width, int height) const {
    const int u = mirrored_x ? width - 1 - x : x;
    const int v = mirrored_y ? height - 1 - y : y;
    return transposed ? std::pair{v, u} : std::pair{u, v};
  }
};

std::vector<Symmetry> symmetries() {
  std::vector<Symmetry> all;
  for (unsigned bits = 1; bits < 8; ++bits) {
    all.push_back({(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0});
  }
  return all;
}

Counts transformed(const Counts& frame, const Symmetry& symmetry) {
  const bool swap = symmetry.transposed;
  Counts out(swap ? frame.height() : frame.width(), swap ? frame.width() : frame.height());
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const auto [u, v] = symmetry.source(x, y, out.width(), out.height());
      out(x, y) = frame(u, v);
    }
  }
  return out;
}

// The pixels of the kept edges of the transformed frame, where they lie in the frame itself.
Mask kept_pixels(const DetectorOptions& options, const Counts& frame, const Symmetry& symmetry) {
  const Counts other = transformed(frame, symmetry);
  auto detector = Detector::create(options);
  const EdgeSet set = detector->detect(other)->edges;
  Mask mask(frame.width(), frame.height());
  fill_pixels(mask.view(), std::uint8_t{0});
  for (const Edge& edge : set.kept_edges()) {
    for (std::size_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      const auto x = static_cast<int>(std::floor(set.edgels.x[i] + 0.5F));
      const auto y = static_cast<int>(std::floor(set.edgels.y[i] + 0.5F));
      const auto [u, v] = symmetry.source(x, y, other.width(), other.height());
      mask(u, v) = 1;
    }
  }
  return mask;
}

// Of the pixels of `a`, the share that has one of `b` no farther than 1 px.
double share_within_1px(const Mask& a, const Mask& b) {
  const auto is_set = [&](int x, int y) { return b.view().contains(x, y) && b(x, y) != 0; };
  double pixels = 0;
  double near = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (a(x, y) != 0) {
        ++pixels;
        near += is_set(x, y) || is_set(x - 1, y) || is_set(x + 1, y) || is_set(x, y - 1) ||
                        is_set(x, y + 1)
                    ? 1
                    : 0;
      }
    }
  }
  return pixels > 0 ? near / pixels : 1;
}

struct Agreement {
  double mean = 0;
  double least = 1;
};

// Both ways, over the seven transformed frames.
Agreement agreement(Preset preset, const Counts& frame) {
  DetectorOptions options = DetectorOptions(preset);
  options.threads = 1;
  const Mask mask = kept_pixels(options, frame, {false, false, false});
  EXPECT_GT(std::count(mask.row(mask.height() / 2), mask.row(mask.height() / 2) + mask.width(), 1),
            0);
  Agreement agreement;
  for (const Symmetry& symmetry : symmetries()) {
    const Mask other = kept_pixels(options, frame, symmetry);
    for (const double share : {share_within_1px(mask, other), share_within_1px(other, mask)}) {
      agreement.mean += share / 14;
      agreement.least = std::min(agreement.least, share);
    }
  }
  return agreement;
}

Counts desk(double sigma_counts) {
  sim::SceneOptions scene;
  scene.camera.sigma_counts = sigma_counts;
  auto frame = sim::render(scene, 0);
  EXPECT_TRUE(frame);
  return std::move(frame->counts);
}

class SymmetryOfEdges : public testing::TestWithParam<Preset> {};

TEST_P(SymmetryOfEdges, IsExactToAPixelWithoutNoise) {
  EXPECT_GE(agreement(GetParam(), desk(0)).least, 0.995);
}

TEST_P(SymmetryOfEdges, HoldsInNoise) {
  for (const double sigma : {6.0, 20.0}) {
    const Agreement found = agreement(GetParam(), desk(sigma));
    EXPECT_GE(found.mean, 0.99) << "sigma " << sigma;
    EXPECT_GE(found.least, 0.96) << "sigma " << sigma;
  }
}

TEST_P(SymmetryOfEdges, HoldsOnFramesOfACamera) {
  THERMEDGE_NEEDS_SHARED("data/optris_pi450");
  const std::filesystem::path frames = test::shared_directory() / "data" / "optris_pi450";
  double mean = 0;
  for (const char* name :
       {"frame000000.png", "frame000028.png", "frame000056.png", "frame000084.png"}) {
    auto source = io::open_files({(frames / name).string()}, {});
    ASSERT_TRUE(source);
    io::SourceFrame frame;
    ASSERT_TRUE((*source)->next(frame));
    mean += agreement(GetParam(), frame.counts).mean / 4;
  }
  // The bilateral filter takes rows first, then columns, which moves the faintest edges of a
  // transposed frame; the others agree.
  EXPECT_GE(mean, 0.97);
}

INSTANTIATE_TEST_SUITE_P(Of, SymmetryOfEdges, testing::Values(Preset::kRobust, Preset::kFast),
                         [](const auto& test) { return std::string(preset_name(test.param)); });

}  // namespace
}  // namespace thermedge
