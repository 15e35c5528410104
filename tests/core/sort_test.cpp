// Sorting of short lists against the standard library.
#include "sort_simd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/images.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;

// Values around 0 of which some are equal, with two zeros of either sign among them.
std::vector<double> values_for(std::size_t count) {
  const auto noise = noise_image<float>(static_cast<int>(count) + 1, 1, 0, 9, 51);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = noise(static_cast<int>(i), 0);
    values.push_back(i % 3 == 0 ? std::round(value) : value);
  }
  if (count > 3) {
    values[1] = 0.0;
    values[2] = -0.0;
  }
  return values;
}

TEST(Sorting, IsThatOfTheStandardLibrary) {
  for (std::size_t count = 0; count <= detail::kFewValues + 40; ++count) {
    const std::vector<double> values = values_for(count);
    std::vector<double> expected = values;
    std::stable_sort(expected.begin(), expected.end());
    for_each_simd_target([&](const std::string& target) {
      std::vector<double> sorted = values;
      sorted.push_back(-1000);  // behind the list: not touched
      detail::sort_values(std::span(sorted).first(count));
      EXPECT_EQ(sorted.back(), -1000);
      sorted.pop_back();
      EXPECT_EQ(sorted, expected) << count << " values, " << target;
      for (std::size_t i = 0; i < count && count <= detail::kFewValues; ++i) {
        EXPECT_EQ(std::signbit(sorted[i]), std::signbit(expected[i])) << "equals keep their order";
      }
    });
  }
}

}  // namespace
}  // namespace thermedge
