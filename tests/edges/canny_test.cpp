#include "thermedge/stages/canny.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "support/images.hpp"
#include "support/runners.hpp"

namespace thermedge {
namespace {

using test::all_runners;
using test::for_each_simd_target;
using test::noise_image;
using test::same_pixels;

// Algorithm 2 as it is written, in double precision. Exact on 8-bit pictures: their squared
// magnitudes are integers below 2^24, and no ratio of their gradients comes near tan 22.5 degrees.
class ReferenceCanny {
 public:
  ReferenceCanny(ImageView<const float> in, const CannyOptions& options)
      : in_(in),
        gx(in.width(), in.height()),
        gy(in.width(), in.height()),
        magnitude(in.width(), in.height()),
        edges(in.width(), in.height()) {
    find_gradients();
    choose_thresholds(options);
    suppress();
    connect();
  }

 private:
  ImageView<const float> in_;

 public:
  Image<float> gx, gy, magnitude;
  Image<std::uint8_t> edges;
  double low = 0, high = 0;

 private:
  double at(int x, int y) const {
    return in_(std::clamp(x, 0, in_.width() - 1), std::clamp(y, 0, in_.height() - 1));
  }

  void find_gradients() {
    for (int y = 0; y < in_.height(); ++y) {
      for (int x = 0; x < in_.width(); ++x) {
        double dx = 0;
        double dy = 0;
        for (int i = -1; i <= 1; ++i) {
          dx += (2 - std::abs(i)) * (at(x + 1, y + i) - at(x - 1, y + i));
          dy += (2 - std::abs(i)) * (at(x + i, y + 1) - at(x + i, y - 1));
        }
        gx(x, y) = static_cast<float>(dx);
        gy(x, y) = static_cast<float>(dy);
        magnitude(x, y) = static_cast<float>(std::sqrt(dx * dx + dy * dy));
      }
    }
  }

  void choose_thresholds(const CannyOptions& options) {
    double largest = 0;
    for (int y = 0; y < in_.height(); ++y) {
      for (int x = 0; x < in_.width(); ++x) {
        largest = std::max<double>(largest, magnitude(x, y));
      }
    }
    high = options.high_threshold;
    if (high == 0) {
      for (int bins = 1; bins <= 64; ++bins) {
        high = bins * largest / 64;
        const auto below = static_cast<double>(count_in_bins(bins, largest));
        if (below > options.non_edge_share * static_cast<double>(in_.size())) {
          break;
        }
      }
    }
    low = options.low_over_high * high;
  }

  // Pixels whose bin is among the first `bins`; the last bin takes the largest magnitude as well.
  int count_in_bins(int bins, double largest) const {
    int count = 0;
    for (int y = 0; y < in_.height(); ++y) {
      for (int x = 0; x < in_.width(); ++x) {
        count += bins == 64 || magnitude(x, y) * (64 / largest) < bins;
      }
    }
    return count;
  }

  void suppress() {
    const double tan_22_5 = std::numbers::sqrt2 - 1;
    for (int y = 1; y + 1 < in_.height(); ++y) {
      for (int x = 1; x + 1 < in_.width(); ++x) {
        const double dx = std::abs(gx(x, y));
        const double dy = std::abs(gy(x, y));
        int step_x = 1;
        int step_y = 1;
        if (dy < tan_22_5 * dx) {
          step_y = 0;
        } else if (dx < tan_22_5 * dy) {
          step_x = 0;
        } else if ((gx(x, y) < 0) != (gy(x, y) < 0)) {
          step_x = -1;
        }
        const float centre = magnitude(x, y);
        const bool ridge = centre > magnitude(x - step_x, y - step_y) &&
                           centre >= magnitude(x + step_x, y + step_y);
        if (ridge && centre > static_cast<float>(low)) {
          edges(x, y) = centre > static_cast<float>(high) ? 255 : 1;
        }
      }
    }
  }

  void connect() {
    for (bool changed = true; changed;) {
      changed = false;
      for (int y = 1; y + 1 < in_.height(); ++y) {
        for (int x = 1; x + 1 < in_.width(); ++x) {
          if (edges(x, y) == 1 && touches_edge(x, y)) {
            edges(x, y) = 255;
            changed = true;
          }
        }
      }
    }
    for (int y = 0; y < in_.height(); ++y) {
      std::replace(edges.row(y), edges.row(y) + in_.width(), std::uint8_t{1}, std::uint8_t{0});
    }
  }

  bool touches_edge(int x, int y) const {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        if (edges(x + i, y + j) == 255) {
          return true;
        }
      }
    }
    return false;
  }
};

// Noise with a step and a flat part, in the middle of NaNs: a read outside makes the run fail.
class Picture {
 public:
  Picture(int width, int height, unsigned seed)
      : buffer_(width + 2 * kMargin, height + 2 * kMargin) {
    fill_pixels(buffer_.view(), std::numeric_limits<float>::quiet_NaN());
    const auto noise = noise_image<std::uint8_t>(width, height, 100, 12, seed);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int step = x + y > (width + height) / 2 ? 90 : 0;
        const bool flat = x < width / 3;
        buffer_(x + kMargin, y + kMargin) = static_cast<float>(step + (flat ? 100 : noise(x, y)));
      }
    }
    view_ = buffer_.view().crop(kMargin, kMargin, width, height);
  }
  [[nodiscard]] ImageView<const float> view() const { return view_; }

 private:
  static constexpr int kMargin = 20;
  Image<float> buffer_;
  ImageView<float> view_;
};

std::vector<std::pair<int, int>> small_sizes() {
  std::vector<std::pair<int, int>> sizes;
  for (int width = 1; width <= 20; ++width) {
    for (int height = 1; height <= 20; ++height) {
      sizes.emplace_back(width, height);
    }
  }
  for (const int width : {31, 32, 33, 34, 63, 64, 65, 66}) {
    for (const int height : {31, 32, 33, 34, 65}) {
      sizes.emplace_back(width, height);
    }
  }
  return sizes;
}

void expect_same(const CannyResult& result, const ReferenceCanny& expected) {
  ASSERT_TRUE(same_pixels<float>(result.gx, expected.gx));
  ASSERT_TRUE(same_pixels<float>(result.gy, expected.gy));
  ASSERT_TRUE(same_pixels<float>(result.magnitude, expected.magnitude));
  ASSERT_NEAR(result.high, expected.high, 1e-6 * expected.high);
  ASSERT_NEAR(result.low, expected.low, 1e-6 * expected.high);
  ASSERT_TRUE(same_pixels<std::uint8_t>(result.edges, expected.edges));
}

TEST(CannyReference, AgreesOnAllSmallSizesTargetsAndRunners) {
  const std::vector<CannyOptions> variants = {{}, {150, 0.7, 0.5}, {0, 0.9, 0.2}};
  const auto runners = all_runners();
  for (const CannyOptions& options : variants) {
    Canny canny(options);  // one object for all sizes: nothing may be left over from the last one
    for (const auto& [width, height] : small_sizes()) {
      SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
      const Picture picture(width, height, static_cast<unsigned>(width * 100 + height));
      const ReferenceCanny expected(picture.view(), options);
      for_each_simd_target([&](const std::string&) {
        for (const auto& runner : runners) {
          const auto result = canny.run(picture.view(), *runner);
          ASSERT_TRUE(result) << result.error().message;
          ASSERT_NO_FATAL_FAILURE(expect_same(*result, expected));
        }
      });
      if (testing::Test::HasFatalFailure()) {
        return;
      }
    }
  }
}

TEST(Canny, RefusesWhatItCannotUse) {
  const auto runner = make_runner(1);
  EXPECT_FALSE(Canny({}).run({}, *runner));
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        std::numeric_limits<float>::lowest()}) {
    for (const int width : {1, 5, 40}) {
      auto frame = noise_image<float>(width, 40, 0, 1, 1);
      frame(width - 1, 39) = bad;
      const auto result = Canny({}).run(frame, *runner);
      if (bad < 0 && width == 1) {
        continue;  // finite, and may be far away from overflow in a narrow frame
      }
      ASSERT_FALSE(result) << bad << " in a frame " << width << " wide";
      EXPECT_NE(result.error().message.find("finite"), std::string::npos);
    }
  }
  CannyOptions options;
  options.low_over_high = 1.5;
  const auto result = Canny(options).run(noise_image<float>(8, 8, 0, 1, 1), *runner);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("canny.low_over_high"), std::string::npos);
}

TEST(Canny, FindsNothingInConstantFrames) {
  const auto runner = make_runner(1);
  Image<float> frame(40, 40);
  fill_pixels(frame.view(), 127.0F);
  for (const CannyOptions& options :
       {CannyOptions{}, CannyOptions{0, 0, 0}, CannyOptions{5, 0, 0}}) {
    Canny canny(options);
    const auto result = canny.run(frame, *runner);
    ASSERT_TRUE(result);
    for (int y = 0; y < 40; ++y) {
      EXPECT_EQ(std::count(result->edges.row(y), result->edges.row(y) + 40, 0), 40);
    }
  }
}

// Two groups of weak pixels; only one of them holds a strong pixel.
TEST(Canny, KeepsWeakPixelsThatAreConnectedToStrongOnes) {
  const auto runner = make_runner(1);
  Image<float> frame(60, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 60; ++x) {
      const float left = x >= 15 ? 10.0F : (y >= 35 ? -30.0F : 0.0F);
      frame(x, y) = left + (x >= 45 ? 10.0F : 0.0F);
    }
  }
  Canny canny({60, 0.7, 0.4});  // the steps of 10 have magnitude 40, those of 40 have 160
  const auto result = canny.run(frame, *runner);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->low, static_cast<double>(0.4F * 60));
  EXPECT_EQ(result->edges(14, 5), 255) << "weak, connected downwards";
  EXPECT_EQ(result->edges(44, 5), 0) << "weak, alone";
}

// A step of 100, blurred by a pixel, across a line through (40.2, 40.2).
struct BlurredStep {
  double cosine, sine;  // of the direction of the gradient

  explicit BlurredStep(double angle_deg)
      : cosine(std::cos(angle_deg * std::numbers::pi / 180)),
        sine(std::sin(angle_deg * std::numbers::pi / 180)) {}
  [[nodiscard]] double distance(double x, double y) const {
    return (x - 40.2) * cosine + (y - 40.2) * sine;
  }
  [[nodiscard]] Image<float> render() const {
    Image<float> frame(81, 81);
    for (int y = 0; y < 81; ++y) {
      for (int x = 0; x < 81; ++x) {
        frame(x, y) = static_cast<float>(50 * std::erfc(-distance(x, y) / std::numbers::sqrt2));
      }
    }
    return frame;
  }
};

// Each row that the line crosses (each column, where it is nearer to horizontal) holds one edge
// pixel on the line. At 45 degrees it holds two, because suppression compares pixels of every
// second diagonal.
TEST(Canny, PutsBlurredStepsWhereTheyAre) {
  const auto runner = make_runner(1);
  for (const double angle_deg : {0.0, 15.0, 40.0, 45.0, 70.0, 90.0, 110.0, 135.0, 160.0}) {
    SCOPED_TRACE(angle_deg);
    const BlurredStep step(angle_deg);
    Canny canny({100, 0.7, 0.4});
    const auto result = canny.run(step.render(), *runner);
    ASSERT_TRUE(result);
    const bool by_rows = std::abs(step.cosine) >= std::abs(step.sine);
    for (int line = 2; line < 79; ++line) {
      int found = 0;
      for (int i = 1; i < 80; ++i) {
        const int x = by_rows ? i : line;
        const int y = by_rows ? line : i;
        if (result->edges(x, y) == 255) {
          ++found;
          EXPECT_LT(std::abs(step.distance(x, y)), 0.72) << x << ", " << y;
        }
      }
      EXPECT_GE(found, 1) << "row or column " << line;
      EXPECT_LE(found, 2) << "row or column " << line;
    }
  }
}

}  // namespace
}  // namespace thermedge
