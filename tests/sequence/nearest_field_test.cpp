// The painted field against a search over all points.
#include "nearest_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace thermedge::detail {
namespace {

TEST(NearestField, HoldsTheNearerOfTwoLines) {
  NearestField field;
  field.start(40, 30);
  for (int x = 5; x < 35; ++x) {
    field.paint(x, static_cast<float>(x), 10, 0, 1);
    field.paint(100 + x, static_cast<float>(x), 15.2F, 0, 1);
  }
  for (int y = 0; y < 30; ++y) {
    const std::int32_t found = field.at(20, static_cast<float>(y));
    const double to_first = std::abs(y - 10);
    const double to_second = std::abs(y - 15.2);
    if (std::min(to_first, to_second) > NearestField::kReachPx + 0.5) {
      EXPECT_EQ(found, NearestField::kNone) << y;
    } else if (std::abs(to_first - to_second) > 1) {
      EXPECT_EQ(found, to_first < to_second ? 20 : 120) << y;
    }
  }
}

TEST(NearestField, ThePointThatWasPaintedFirstWinsWhereTwoAreAsNear) {
  NearestField field;
  field.start(20, 20);
  field.paint(7, 10, 8, 0, 1);
  field.paint(3, 10, 12, 0, 1);
  EXPECT_EQ(field.at(10, 10), 7);
}

TEST(NearestField, IsEmptyOutsideAndAfterAStart) {
  NearestField field;
  field.start(20, 20);
  field.paint(1, 0, 0, 1, 0);
  EXPECT_EQ(field.at(0.4F, -0.4F), 1);
  EXPECT_EQ(field.at(-0.6F, 0), NearestField::kNone);
  EXPECT_EQ(field.at(19.6F, 0), NearestField::kNone);
  field.start(20, 20);
  EXPECT_EQ(field.at(0, 0), NearestField::kNone);
}

}  // namespace
}  // namespace thermedge::detail
