// Column and row offsets: what is taken away, and what of the scene is left alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "lag_sums_simd.hpp"
#include "support/images.hpp"
#include "support/runners.hpp"
#include "thermedge/stages/noise.hpp"
#include "thermedge/stages/stripes.hpp"

namespace thermedge {
namespace {

constexpr int kWidth = 382;
constexpr int kHeight = 288;

struct Scene {
  double sigma = 20;         // counts
  double stripe_sigmas = 0;  // of the columns; rows have three quarters of it
  double step_sigmas = 0;    // of an edge along a column (or row)
  double share = 1;          // of the height (or width) that the edge has
  bool along_row = false;
  double dome_sigmas = 0;  // above the corners, over the whole frame
  unsigned seed = 1;
};

struct Rendered {
  Image<std::uint16_t> frame;
  std::vector<double> columns, rows;  // offsets
  int edge = 0;                       // the first column (or row) behind the edge
};

Rendered render(const Scene& scene) {
  std::mt19937 random(scene.seed);
  std::normal_distribution<double> normal(0, scene.sigma);
  Rendered out;
  for (int x = 0; x < kWidth; ++x) {
    out.columns.push_back(scene.stripe_sigmas * normal(random));
  }
  for (int y = 0; y < kHeight; ++y) {
    out.rows.push_back(0.75 * scene.stripe_sigmas * normal(random));
  }
  const int along = scene.along_row ? kWidth : kHeight;
  const int across = scene.along_row ? kHeight : kWidth;
  out.edge = 40 + static_cast<int>(random() % static_cast<unsigned>(across - 80));
  const int length = static_cast<int>(scene.share * along);
  const int begin = static_cast<int>(random() % static_cast<unsigned>(along - length + 1));
  out.frame.resize(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int u = scene.along_row ? x : y;
      const int v = scene.along_row ? y : x;
      const bool has_edge = u >= begin && u < begin + length;
      const double behind = 0.5 * std::erfc((out.edge - 0.5 - v) / std::numbers::sqrt2);
      const double radius = std::hypot(2.0 * x / kWidth - 1, 2.0 * y / kHeight - 1);
      const double value = 3000 + scene.dome_sigmas * scene.sigma * std::exp(-radius * radius) +
                           0.5 * scene.sigma * std::sin(x / 90.0 + y / 70.0) +
                           (has_edge ? scene.step_sigmas * scene.sigma * behind : 0) +
                           out.columns[static_cast<std::size_t>(x)] +
                           out.rows[static_cast<std::size_t>(y)] + normal(random);
      out.frame(x, y) = static_cast<std::uint16_t>(std::lround(value));
    }
  }
  return out;
}

StripeOffsets measured(ImageView<const std::uint16_t> frame, double sigma, ParallelRunner& runner) {
  StripeOffsets offsets;
  StripeFinder().measure(frame, sigma, runner, offsets);
  return offsets;
}

StripeOffsets measured(ImageView<const std::uint16_t> frame) {
  return measured(frame, NoiseEstimator().measure(frame).sigma_counts, *make_runner(1));
}

double at(const std::vector<float>& offsets, int i) {
  return offsets.empty() ? 0 : offsets[static_cast<std::size_t>(i)];
}

// What is left of an offset against its neighbours; slow drifts over many columns are no stripes.
// Not near `edge`.
double left_over(const std::vector<float>& found, const std::vector<double>& truth,
                 int edge = -1000) {
  constexpr int kReach = 12;
  constexpr int kNear = 30;
  const int n = static_cast<int>(truth.size());
  double squares = 0;
  int number = 0;
  for (int i = kReach; i < n - kReach; ++i) {
    if (std::abs(i - edge) < kNear) {
      continue;
    }
    const auto error = [&](int k) { return truth[static_cast<std::size_t>(k)] - at(found, k); };
    double around = 0;
    for (int k = i - kReach; k <= i + kReach; ++k) {
      around += k == i ? 0 : error(k) / (2 * kReach);
    }
    squares += std::pow(error(i) - around, 2);
    ++number;
  }
  return std::sqrt(squares / number);
}

TEST(Stripes, TuningSaysFromWhatStrengthOn) {
  Scene scene;
  scene.stripe_sigmas = 1.0 / 3;
  const Rendered rendered = render(scene);
  StripeOffsets found;
  const auto runner = make_runner(1);
  StripeFinder().measure(rendered.frame, scene.sigma, *runner, found);
  EXPECT_FALSE(found.columns.empty());
  StripeFinder({.least_variance_ratio = 1e6}).measure(rendered.frame, scene.sigma, *runner, found);
  EXPECT_TRUE(found.columns.empty());
}

TEST(Stripes, AreRemovedToATwelfthOfTheNoise) {
  for (const auto& [stripe, left] :
       {std::pair{0.15, 0.08}, {1.0 / 3, 0.08}, {1.0, 0.08}, {3.0, 0.08}}) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
      Scene scene;
      scene.stripe_sigmas = stripe;
      scene.seed = seed;
      const Rendered rendered = render(scene);
      const StripeOffsets found = measured(rendered.frame);
      EXPECT_LT(left_over(found.columns, rendered.columns), left * scene.sigma) << stripe;
      EXPECT_LT(left_over(found.rows, rendered.rows), left * scene.sigma) << stripe;
    }
  }
}

// Mean over seeds of the share of an edge's contrast that is left, 5 px to either side.
double kept_contrast(Scene scene) {
  constexpr int kSeeds = 16;
  double sum = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    scene.seed = seed;
    const Rendered rendered = render(scene);
    const StripeOffsets found = measured(rendered.frame);
    const auto taken = [&](int i) {
      return scene.along_row ? at(found.rows, i) - rendered.rows[static_cast<std::size_t>(i)]
                             : at(found.columns, i) - rendered.columns[static_cast<std::size_t>(i)];
    };
    double step = 0;
    for (int i = 0; i < 5; ++i) {
      step += (taken(rendered.edge + i) - taken(rendered.edge - 1 - i)) / 5;
    }
    sum += 1 - step / (scene.step_sigmas * scene.sigma);
  }
  return sum / kSeeds;
}

TEST(Stripes, AreNotTakenFromEdgesAlongThem) {
  for (const bool along_row : {false, true}) {
    for (const double step : {1.0, 3.0, 30.0}) {
      SCOPED_TRACE((along_row ? "row, " : "column, ") + std::to_string(step) + " sigma");
      Scene scene;
      scene.stripe_sigmas = 1.0 / 3;
      scene.step_sigmas = step;
      scene.along_row = along_row;
      scene.share = 0.4;
      EXPECT_NEAR(kept_contrast(scene), 1, 0.1);
      scene.share = 1;
      EXPECT_NEAR(kept_contrast(scene), 1, 0.15);
    }
  }
}

// Stripes of three times the noise: a wall of ten sigma stays, and they are removed on both sides.
TEST(Stripes, OfThreeSigmaAreToldFromAWall) {
  for (const bool along_row : {false, true}) {
    Scene scene;
    scene.stripe_sigmas = 3;
    scene.step_sigmas = 10;
    scene.along_row = along_row;
    EXPECT_NEAR(kept_contrast(scene), 1, 0.2) << along_row;
    scene.step_sigmas = 100;
    EXPECT_NEAR(kept_contrast(scene), 1, 0.02) << along_row;
    scene.share = 0.4;
    EXPECT_NEAR(kept_contrast(scene), 1, 0.02) << along_row;
    for (const double share : {0.4, 0.7, 1.0}) {
      scene.share = share;
      const Rendered rendered = render(scene);
      const StripeOffsets found = measured(rendered.frame);
      const int column = along_row ? -1000 : rendered.edge;
      const int row = along_row ? rendered.edge : -1000;
      EXPECT_LT(left_over(found.columns, rendered.columns, column), 0.1 * scene.sigma) << share;
      EXPECT_LT(left_over(found.rows, rendered.rows, row), 0.1 * scene.sigma) << share;
    }
  }
}

// The largest step that an error of the offsets makes between four of them and the next four.
double largest_step(const std::vector<float>& found, const std::vector<double>& truth) {
  constexpr int kSide = 4;
  double largest = 0;
  for (int i = kSide; i + kSide <= static_cast<int>(truth.size()); ++i) {
    double step = 0;
    for (int k = 0; k < kSide; ++k) {
      const auto error = [&](int j) { return at(found, j) - truth[static_cast<std::size_t>(j)]; };
      step += (error(i + k) - error(i - 1 - k)) / kSide;
    }
    largest = std::max(largest, std::abs(step));
  }
  return largest;
}

TEST(Stripes, OnADomeAreNoneOfItsSlope) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Scene scene;
    scene.stripe_sigmas = 1.0 / 3;
    scene.dome_sigmas = 40;
    scene.seed = seed;
    const Rendered rendered = render(scene);
    const StripeOffsets found = measured(rendered.frame);
    EXPECT_LT(left_over(found.columns, rendered.columns), 0.12 * scene.sigma);
    EXPECT_LT(left_over(found.rows, rendered.rows), 0.12 * scene.sigma);
    EXPECT_LT(largest_step(found.columns, rendered.columns), 0.35 * scene.sigma);
    EXPECT_LT(largest_step(found.rows, rendered.rows), 0.35 * scene.sigma);
  }
}

// Counts at either end of their range leave room for the offsets on one side only.
TEST(Stripes, AreTheSameAtEveryLevel) {
  Scene scene;
  scene.stripe_sigmas = 3;
  scene.step_sigmas = 5;
  scene.dome_sigmas = 10;
  Rendered rendered = render(scene);
  const StripeOffsets expected = measured(rendered.frame, scene.sigma, *make_runner(1));
  int low = 65535;
  int high = 0;
  for (int y = 0; y < kHeight; ++y) {
    const auto [least, most] =
        std::minmax_element(rendered.frame.row(y), rendered.frame.row(y) + kWidth);
    low = std::min<int>(low, *least);
    high = std::max<int>(high, *most);
  }
  for (const int level : {-low, 65535 - high}) {
    auto frame = rendered.frame.clone();
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        frame(x, y) = static_cast<std::uint16_t>(frame(x, y) + level);
      }
    }
    const StripeOffsets found = measured(frame, scene.sigma, *make_runner(1));
    EXPECT_EQ(found.columns, expected.columns);
    EXPECT_EQ(found.rows, expected.rows);
  }
}

TEST(Stripes, AreFoundWithANoiseThatIsAThirdOff) {
  for (const double factor : {0.7, 1.3}) {
    Scene scene;
    scene.stripe_sigmas = 3;
    const Rendered rendered = render(scene);
    const StripeOffsets found = measured(rendered.frame, factor * scene.sigma, *make_runner(1));
    EXPECT_LT(left_over(found.columns, rendered.columns), 0.08 * scene.sigma);
    EXPECT_LT(left_over(found.rows, rendered.rows), 0.08 * scene.sigma);
  }
}

TEST(Stripes, AreNotSeenWhereThereAreNone) {
  int frames_with_offsets = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Scene scene;
    scene.step_sigmas = seed % 4;
    scene.share = 0.7;
    scene.seed = seed;
    const StripeOffsets found = measured(render(scene).frame);
    frames_with_offsets += found.columns.empty() && found.rows.empty() ? 0 : 1;
  }
  EXPECT_LE(frames_with_offsets, 1);
}

TEST(Stripes, OfFramesTooSmallOrWithoutNoiseAreNone) {
  const auto runner = make_runner(1);
  const auto small = test::noise_image<std::uint16_t>(63, 200, 3000, 10, 1);
  EXPECT_TRUE(measured(small, 10, *runner).columns.empty());
  const auto frame = test::noise_image<std::uint16_t>(200, 100, 3000, 10, 1);
  EXPECT_TRUE(measured(frame, 0, *runner).rows.empty());
  Image<std::uint16_t> flat(100, 100);
  fill_pixels(flat.view(), std::uint16_t{7});
  EXPECT_TRUE(measured(flat, 1, *runner).columns.empty());
}

TEST(Stripes, OfATransposedFrameAreExchanged) {
  for (const double stripes : {0.5, 3.0}) {
    Scene scene;
    scene.stripe_sigmas = stripes;
    const Rendered rendered = render(scene);
    Image<std::uint16_t> transposed(kHeight, kWidth);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        transposed(y, x) = rendered.frame(x, y);
      }
    }
    const auto runner = make_runner(1);
    const StripeOffsets found = measured(rendered.frame, 20, *runner);
    const StripeOffsets exchanged = measured(transposed, 20, *runner);
    EXPECT_EQ(found.columns, exchanged.rows);
    EXPECT_EQ(found.rows, exchanged.columns);
  }
}

TEST(Stripes, AreTheSameOnEveryTargetAndRunner) {
  for (const double stripes : {0.3, 3.0}) {
    Scene scene;
    scene.stripe_sigmas = stripes;
    scene.step_sigmas = 2;
    const Rendered rendered = render(scene);
    const auto of = [&](ParallelRunner& runner) {
      const StripeOffsets found = measured(rendered.frame, 20, runner);
      EXPECT_FALSE(found.columns.empty());
      return found;
    };
    const StripeOffsets expected = of(*make_runner(1));
    for (const auto& runner : test::all_runners()) {
      EXPECT_EQ(of(*runner).columns, expected.columns);
    }
    test::for_each_simd_target([&](const std::string&) {
      EXPECT_EQ(of(*make_runner(2)).columns, expected.columns);
      EXPECT_EQ(of(*make_runner(2)).rows, expected.rows);
    });
  }
}

TEST(Stripes, AreTakenAwayRoundedAndWithinTheRange) {
  Image<std::uint16_t> frame(3, 2);
  fill_pixels(frame.view(), std::uint16_t{10});
  frame(0, 0) = 0;
  frame(2, 1) = 65535;
  remove_stripes({{2.4F, 0.0F, -3.0F}, {0.2F, -1.0F}}, frame);
  EXPECT_EQ(frame(0, 0), 0);
  EXPECT_EQ(frame(1, 0), 10);
  EXPECT_EQ(frame(2, 0), 13);
  EXPECT_EQ(frame(0, 1), 9);
  EXPECT_EQ(frame(1, 1), 11);
  EXPECT_EQ(frame(2, 1), 65535);
  remove_stripes({}, frame);
  EXPECT_EQ(frame(0, 1), 9);
}

TEST(Stripes, LagSumsAreThoseOfThePairsWithinTheLimit) {
  constexpr int kLags = static_cast<int>(detail::kLags.size());
  for (const int limit : {50, detail::kLargestLagDifference}) {
    for (const int width : {1, 2, 9, 15, 16, 17, 33, 70}) {
      for (const int height : {1, 7, detail::most_lag_rows(limit)}) {
        auto counts = test::noise_image<std::uint16_t>(width, height, 3000, 0.8 * limit, 5);
        counts(0, 0) = 65535;
        const auto reach = test::noise_image<std::uint16_t>(width, (height + 1) / 2, 10, 5, 6);
        test::for_each_simd_target([&](const std::string&) {
          Image<std::int16_t> sums(width, kLags);
          Image<std::int16_t> numbers(width, kLags);
          detail::lag_sums(counts, reach, limit, sums, numbers);
          for (int i = 0; i < kLags; ++i) {
            const int lag = detail::kLags[static_cast<std::size_t>(i)];
            for (int x = 0; x < width - lag; ++x) {
              int sum = 0;
              int number = 0;
              for (int y = 0; y < height; ++y) {
                const int difference = counts(x + lag, y) - counts(x, y);
                const bool counted = std::abs(difference) <= limit && reach(x, y / 2) > lag;
                sum += counted ? difference : 0;
                number += counted ? 1 : 0;
              }
              ASSERT_EQ(sums(x, i), sum);
              ASSERT_EQ(numbers(x, i), number);
            }
          }
        });
      }
    }
  }
}

}  // namespace
}  // namespace thermedge
