// The functions of filter tables against the C++ library.
#include "portable_math.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace thermedge::detail {
namespace {

constexpr double kUlp = 0x1p-52;

// Each squaring doubles the relative error; there is one for each doubling of |x| beyond 0.5, so
// that an error of 3 roundings of the series and the squarings grows to at most 12 |x|.
TEST(PortableExp, IsExpWithinTheRoundingOfItsSquarings) {
  for (double x = -300; x <= 300; x += 0.37) {
    const double bound = (4 + 12 * std::abs(x)) * kUlp;
    EXPECT_NEAR(portable_exp(x) / std::exp(x), 1, bound) << x;
  }
  for (double x = -0.5; x <= 0.5; x += 0.001) {
    EXPECT_NEAR(portable_exp(x) / std::exp(x), 1, 4 * kUlp) << x;
  }
}

TEST(PortableExp, IsExactWhereItCanBe) {
  static_assert(portable_exp(0) == 1);
  static_assert(portable_exp(-0.0) == 1);
  static_assert(portable_exp(1) > 2.718281828459 && portable_exp(1) < 2.718281828460);
  EXPECT_EQ(portable_exp(0x1p-60), 1);
  EXPECT_EQ(portable_exp(0x1p-40), 1 + 0x1p-40);
}

TEST(PortableBessel, IsTheLibrarysUpToTheSquare100) {
  static_assert(bessel_i0_of_square(0) == 1);
  for (double x = 0; x <= 10; x += 0.01) {
    EXPECT_NEAR(bessel_i0_of_square(x * x) / std::cyl_bessel_i(0.0, x), 1, 16 * kUlp) << x;
  }
}

}  // namespace
}  // namespace thermedge::detail
