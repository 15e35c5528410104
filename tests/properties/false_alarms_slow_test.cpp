// Edges that are found in frames of nothing but white noise: not more than asked for.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "support/images.hpp"
#include "thermedge/detector.hpp"

namespace thermedge {
namespace {

// A detector for whose denoiser the number of false alarms was measured.
struct Measured {
  Preset preset;
  DenoiseMethod denoiser;
};

std::string name_of(const Measured& measured) {
  return std::string(preset_name(measured.preset)) + "_" +
         std::string(kDenoiseMethods[static_cast<std::size_t>(measured.denoiser)].name);
}

void PrintTo(const Measured& measured, std::ostream* out) { *out << name_of(measured); }

// The smallest number that a Poisson variable of this mean exceeds once in a thousand times at
// most.
std::size_t poisson_bound(double mean) {
  double probability = std::exp(-mean);
  double below = probability;
  std::size_t number = 0;
  while (1 - below > 1e-3) {
    probability *= mean / static_cast<double>(++number);
    below += probability;
  }
  return number;
}

TEST(PoissonBound, IsExceededOnceInAThousandTimes) {
  EXPECT_EQ(poisson_bound(1), 5U);   // P(N > 4) = .0037, P(N > 5) = .0006
  EXPECT_EQ(poisson_bound(6), 15U);  // P(N > 14) = .0014, P(N > 15) = .0005
}

class FalseAlarms : public testing::TestWithParam<Measured> {};

TEST_P(FalseAlarms, AreNotMoreThanAskedFor) {
  DetectorOptions options = DetectorOptions(GetParam().preset);
  options.denoise.method = GetParam().denoiser;
  ASSERT_EQ(options.selection.max_false_alarms, 0.1);
  auto detector = Detector::create(options);
  ASSERT_TRUE(detector);
  constexpr int kFrames = 150;
  std::size_t kept = 0;
  std::size_t insignificant = 0;
  for (unsigned seed = 0; seed < kFrames; ++seed) {
    const double sigma = std::pow(100, seed / (kFrames - 1.0));  // 1 to 100 counts
    const auto frame = test::noise_image<std::uint16_t>(382, 288, 8000, sigma, 900 + seed);
    const auto found = detector->detect(frame);
    ASSERT_TRUE(found) << found.error().message;
    kept += found->edges.kept;
    for (const Edge& edge : found->edges.edges) {
      insignificant += edge.status == EdgeStatus::kInsignificant ? 1 : 0;
    }
  }
  RecordProperty("kept", static_cast<int>(kept));
  RecordProperty("insignificant", static_cast<int>(insignificant));
  EXPECT_LE(kept, poisson_bound(options.selection.max_false_alarms * kFrames));
  EXPECT_GT(insignificant, 0U) << "nothing was there to be tested";
}

INSTANTIATE_TEST_SUITE_P(OfDenoisers, FalseAlarms,
                         testing::Values(Measured{Preset::kRobust, DenoiseMethod::kBm3d},
                                         Measured{Preset::kFast, DenoiseMethod::kGaussian}),
                         [](const auto& test) { return name_of(test.param); });

}  // namespace
}  // namespace thermedge
