// The classical detectors against GNU Octave's `edge` on simulated frames; how the maps were made:
// tests/data/classical/README.md.
#include "thermedge/stages/classical.hpp"

#include <gtest/gtest.h>

#include "thermedge/io/source.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

struct Agreement {
  double pixels = 0;   // share of all pixels that are equal
  double jaccard = 0;  // edge pixels of both over edge pixels of either
  std::size_t edges = 0;
};

Agreement compare(ImageView<const std::uint8_t> ours, ImageView<const std::uint16_t> theirs) {
  std::size_t equal = 0, both = 0, either = 0, edges = 0;
  for (int y = 0; y < ours.height(); ++y) {
    for (int x = 0; x < ours.width(); ++x) {
      const bool a = ours(x, y) != 0;
      const bool b = theirs(x, y) != 0;
      equal += a == b ? 1 : 0;
      both += a && b ? 1 : 0;
      either += a || b ? 1 : 0;
      edges += b ? 1 : 0;
    }
  }
  return {static_cast<double>(equal) / static_cast<double>(ours.size()),
          static_cast<double>(both) / static_cast<double>(either), edges};
}

Image<float> levels_of(const std::string& spec) {
  const auto scene = sim::parse_scene(spec);
  EXPECT_TRUE(scene) << spec;
  const auto frame = sim::render(*scene, 0);
  EXPECT_TRUE(frame);
  Image<std::uint8_t> levels(frame->counts.width(), frame->counts.height());
  EXPECT_TRUE(scale_to_8bit(frame->counts, {}, levels));
  Image<float> out(levels.width(), levels.height());
  copy_pixels(levels.view(), out.view());
  return out;
}

class OctaveEdge : public testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Agreement agreement(ClassicalMethod method, std::string_view name,
                      const ClassicalOptions& options) const {
    const auto& [scene, sigma] = GetParam();
    const std::string sigma_text = std::to_string(sigma);
    const Image<float> levels =
        levels_of(std::string(scene) + "?width=192&height=144&sigma=" + sigma_text);
    Image<std::uint8_t> edges(levels.width(), levels.height());
    EXPECT_TRUE(ClassicalDetector(options).run(levels, method, edges, *make_runner(1)));
    const auto golden = io::read_picture(std::string(THERMEDGE_TEST_DATA) + "/classical/" + scene +
                                         "_" + sigma_text + "_" + std::string(name) + ".png");
    EXPECT_TRUE(golden);
    EXPECT_TRUE(same_size(edges.view(), golden->counts.view()));
    return compare(edges.view(), golden->counts);
  }
};

TEST_P(OctaveEdge, GradientDetectorsAgree) {
  for (const auto& [method, name] : {std::pair{ClassicalMethod::kPrewitt, "prewitt"},
                                     std::pair{ClassicalMethod::kRoberts, "roberts"},
                                     std::pair{ClassicalMethod::kSobel, "sobel"}}) {
    const Agreement found = agreement(method, name, {});
    // Octave divides by 255 first; its rounding breaks a few ties that are exact here.
    EXPECT_GE(found.pixels, 0.999) << name;
    EXPECT_GE(found.jaccard, 0.99) << name;
    EXPECT_GT(found.edges, 200U);
    RecordProperty(std::string(name) + "_pixels", std::to_string(found.pixels));
    RecordProperty(std::string(name) + "_jaccard", std::to_string(found.jaccard));
  }
}

TEST_P(OctaveEdge, LogAgrees) {
  ClassicalOptions options;
  options.log_as_octave = true;
  const Agreement exact = agreement(ClassicalMethod::kLog, "log", options);
  EXPECT_EQ(exact.pixels, 1.0);
  EXPECT_GT(exact.edges, 100U);
  // The kernel without a mean finds more and moves thresholds, so the maps differ in places.
  EXPECT_GE(agreement(ClassicalMethod::kLog, "log", {}).pixels, 0.97);
}

INSTANTIATE_TEST_SUITE_P(Scenes, OctaveEdge,
                         testing::Combine(testing::Values("desk", "corridor"),
                                          testing::Values(6, 20)));

}  // namespace
}  // namespace thermedge
