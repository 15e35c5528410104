#include "thermedge/stages/canny.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/images.hpp"
#include "support/runners.hpp"

namespace thermedge {
namespace {

using test::noise_image;
using test::same_pixels;

// A symmetry of the square: where a pixel of the result comes from, and what becomes of gradients.
struct Symmetry {
  std::string name;
  bool flip_x;
  bool flip_y;
  bool transpose;
};

const std::vector<Symmetry> kSymmetries = {
    {"flip x", true, false, false},       {"flip y", false, true, false},
    {"turn by 180", true, true, false},   {"transpose", false, false, true},
    {"turn by 90", true, false, true},    {"turn by 270", false, true, true},
    {"other transpose", true, true, true}};

template <class T>
Image<T> transformed(const Symmetry& symmetry, ImageView<const T> in) {
  Image<T> out(symmetry.transpose ? in.height() : in.width(),
               symmetry.transpose ? in.width() : in.height());
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      const int to_x = symmetry.flip_x ? in.width() - 1 - x : x;
      const int to_y = symmetry.flip_y ? in.height() - 1 - y : y;
      (symmetry.transpose ? out(to_y, to_x) : out(to_x, to_y)) = in(x, y);
    }
  }
  return out;
}

Image<float> negated(ImageView<const float> in) {
  Image<float> out(in.width(), in.height());
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      out(x, y) = -in(x, y);
    }
  }
  return out;
}

// Pixels with many significant bits: no two magnitudes are alike, so the rule for plateaus, which
// is not symmetric, never applies.
Image<float> picture() { return noise_image<float>(47, 39, 100, 20, 11); }

TEST(CannyProperty, SymmetriesOfThePictureAreThoseOfTheResultBitByBit) {
  const auto runner = make_runner(1);
  const Image<float> original = picture();
  Canny canny({});
  const auto expected = canny.run(original, *runner);
  ASSERT_TRUE(expected);
  for (const Symmetry& symmetry : kSymmetries) {
    SCOPED_TRACE(symmetry.name);
    const Image<float> changed = transformed<float>(symmetry, original);
    Canny other({});
    const auto result = other.run(changed, *runner);
    ASSERT_TRUE(result);
    Image<float> gx = transformed<float>(symmetry, expected->gx);
    Image<float> gy = transformed<float>(symmetry, expected->gy);
    if (symmetry.flip_x) {
      gx = negated(gx);
    }
    if (symmetry.flip_y) {
      gy = negated(gy);
    }
    if (symmetry.transpose) {
      gx.swap(gy);
    }
    EXPECT_TRUE(same_pixels<float>(result->gx, gx));
    EXPECT_TRUE(same_pixels<float>(result->gy, gy));
    EXPECT_TRUE(
        same_pixels<float>(result->magnitude, transformed<float>(symmetry, expected->magnitude)));
    EXPECT_TRUE(same_pixels<std::uint8_t>(result->edges,
                                          transformed<std::uint8_t>(symmetry, expected->edges)));
    EXPECT_EQ(result->high, expected->high);
  }
}

// Runs on a x + b for the pixels x.
void expect_same_edges(float factor, float offset) {
  const auto runner = make_runner(1);
  const auto levels = noise_image<std::uint8_t>(50, 70, 100, 30, 5);
  Image<float> original(50, 70), changed(50, 70);
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 50; ++x) {
      original(x, y) = levels(x, y);
      changed(x, y) = levels(x, y) * factor + offset;
    }
  }
  Canny canny({}), other({});
  const auto expected = canny.run(original, *runner);
  const auto result = other.run(changed, *runner);
  ASSERT_TRUE(expected && result);
  EXPECT_TRUE(same_pixels<std::uint8_t>(result->edges, expected->edges));
  EXPECT_EQ(result->high, expected->high * std::abs(factor));
  EXPECT_GT(expected->high, 0);
}

TEST(CannyProperty, AnOffsetChangesNothing) { expect_same_edges(1, 60000); }

TEST(CannyProperty, AutomaticThresholdsScaleWithThePicture) {
  expect_same_edges(4, 0);
  expect_same_edges(0.125F, 0);
}

TEST(CannyProperty, TheNegativeHasTheSameEdges) { expect_same_edges(-1, 0); }

TEST(CannyProperty, LowerThresholdsOnlyAddEdges) {
  const auto runner = make_runner(1);
  const Image<float> frame = picture();
  Canny strict({160, 0.7, 0.5}), loose({120, 0.7, 0.5});
  const auto few = strict.run(frame, *runner);
  const auto many = loose.run(frame, *runner);
  ASSERT_TRUE(few && many);
  int added = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      EXPECT_LE(few->edges(x, y), many->edges(x, y));
      added += few->edges(x, y) != many->edges(x, y);
    }
  }
  EXPECT_GT(added, 0);
}

}  // namespace
}  // namespace thermedge
