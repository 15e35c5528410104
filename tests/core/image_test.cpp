// Views, owners and transposition of pictures.
#include "thermedge/image.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>
#include <vector>

#include "support/images.hpp"
#include "support/strided_image.hpp"
#include "thermedge/memory.hpp"
#include "transpose.hpp"

namespace thermedge {
namespace {

using test::noise_image;
using test::same_pixels;
using test::StridedImage;

TEST(ImageView, OfABufferWithGapsBetweenItsRows) {
  std::vector<int> buffer(20);
  std::iota(buffer.begin(), buffer.end(), 0);
  const ImageView<int> view(buffer.data() + 1, 3, 4, 5);
  EXPECT_EQ(view(0, 0), 1);
  EXPECT_EQ(view(2, 0), 3);
  EXPECT_EQ(view(0, 3), 16);
  EXPECT_EQ(*view.row(2), 11);
  EXPECT_EQ(view.size(), 12U);
  const ImageView<const int> part = view.crop(1, 2, 2, 1);
  EXPECT_EQ(part.width(), 2);
  EXPECT_EQ(part.height(), 1);
  EXPECT_EQ(part(1, 0), 13);
  EXPECT_EQ(part.stride(), 5);
}

TEST(ImageView, ContainsItsPixelsOnly) {
  const ImageView<int> view(nullptr, 3, 2);
  for (int y = -2; y <= 4; ++y) {
    for (int x = -2; x <= 4; ++x) {
      const bool one_of_six = (x == 0 || x == 1 || x == 2) && (y == 0 || y == 1);
      EXPECT_EQ(view.contains(x, y), one_of_six) << x << ", " << y;
    }
  }
}

TEST(ImageView, IsEmptyWhereASideIsZero) {
  EXPECT_TRUE(ImageView<int>().empty());
  EXPECT_TRUE(ImageView<int>(nullptr, 0, 3).empty());
  EXPECT_TRUE(ImageView<int>(nullptr, 3, 0).empty());
  EXPECT_FALSE(ImageView<int>(nullptr, 1, 1).empty());
  EXPECT_TRUE(same_size(ImageView<int>(nullptr, 3, 0), ImageView<char>(nullptr, 3, 0)));
  EXPECT_FALSE(same_size(ImageView<int>(nullptr, 3, 0), ImageView<char>(nullptr, 0, 3)));
}

TEST(CopyPixels, ConvertsAndWritesNothingElse) {
  for (const auto& [width, height] : {std::pair{0, 3}, {3, 0}, {1, 1}, {5, 4}, {64, 2}}) {
    const auto from = noise_image<std::uint16_t>(width, height, 500, 300, 61);
    StridedImage<std::uint8_t> to(width, height);
    copy_pixels(from.view(), to.view());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        EXPECT_EQ(to.view()(x, y), from(x, y) % 256);
      }
    }
    EXPECT_TRUE(to.intact());
    fill_pixels(to.view(), std::uint8_t{3});
    for (int y = 0; y < height; ++y) {
      EXPECT_EQ(std::count(to.view().row(y), to.view().row(y) + width, 3), width);
    }
    EXPECT_TRUE(to.intact());
  }
}

template <class T>
void expect_padded_rows() {
  for (int width = 0; width <= 130; ++width) {
    const Image<T> image(width, 3);
    for (int y = 0; y < 3; ++y) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(image.row(y)) % 64, 0U) << width;
    }
    EXPECT_GE((image.stride() - width) * static_cast<std::ptrdiff_t>(sizeof(T)), 64) << width;
    EXPECT_GE(image.capacity_bytes(), 3 * sizeof(T) * static_cast<std::size_t>(image.stride()));
  }
}

TEST(Image, RowsAreAlignedAndEndWithASpareVector) {
  expect_padded_rows<std::uint8_t>();
  expect_padded_rows<std::uint16_t>();
  expect_padded_rows<float>();
  expect_padded_rows<double>();
}

TEST(Image, KeepsMemoryThatIsLargeEnough) {
  Image<float> image(100, 50);
  const float* before = image.row(0);
  const std::size_t bytes = image.capacity_bytes();
  for (const auto& [width, height] : {std::pair{50, 80}, {100, 50}, {0, 0}, {100, 50}}) {
    image.resize(width, height);
    EXPECT_EQ(image.width(), width);
    EXPECT_EQ(image.height(), height);
    EXPECT_EQ(image.view().data(), before);
    EXPECT_EQ(image.capacity_bytes(), bytes);
  }
  image.resize(100, 51);
  EXPECT_GT(image.capacity_bytes(), bytes);
}

TEST(Image, ClonesAreIndependentAndMovesTakeThePixels) {
  Image<std::uint16_t> image = noise_image<std::uint16_t>(9, 5, 100, 30, 62);
  Image<std::uint16_t> copy = image.clone();
  EXPECT_TRUE(same_pixels<std::uint16_t>(copy, image));
  const std::uint16_t first = image(0, 0);
  copy(0, 0) = static_cast<std::uint16_t>(first + 1);
  EXPECT_EQ(image(0, 0), first);
  const std::uint16_t* pixels = image.row(0);
  Image<std::uint16_t> moved = std::move(image);
  EXPECT_EQ(moved.row(0), pixels);
  copy = std::move(moved);
  EXPECT_EQ(copy.row(0), pixels);
  EXPECT_EQ(copy(0, 0), first);
}

TEST(Transpose, SwapsRowsAndColumnsForSizesAroundItsBlocks) {
  for (const int width : {0, 1, 2, 31, 32, 33, 65}) {
    for (const int height : {0, 1, 31, 32, 33, 64, 67}) {
      StridedImage<std::uint16_t> from(width, height);
      copy_pixels(noise_image<std::uint16_t>(width, height, 9000, 3000, 63).view(), from.view());
      StridedImage<std::uint16_t> to(height, width);
      detail::transpose<std::uint16_t>(from.view(), to.view());
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          ASSERT_EQ(to.view()(y, x), from.view()(x, y)) << width << "x" << height;
        }
      }
      EXPECT_TRUE(to.intact());
    }
  }
}

TEST(Memory, IsTheSumOfTheCapacitiesOfAllParts) {
  struct Part {
    [[nodiscard]] std::size_t memory_bytes() const { return 1000; }
  };
  std::vector<int> numbers;
  numbers.reserve(10);
  std::vector<std::vector<double>> nested(2);
  nested[0].reserve(7);
  const std::size_t of_nested = nested.capacity() * sizeof(std::vector<double>) +
                                (nested[0].capacity() + nested[1].capacity()) * sizeof(double);
  const Image<float> image(3, 2);
  EXPECT_EQ(detail::memory_of(), 0U);
  EXPECT_EQ(detail::memory_of(numbers), numbers.capacity() * sizeof(int));
  EXPECT_EQ(detail::memory_of(nested), of_nested);
  EXPECT_EQ(detail::memory_of(image), image.capacity_bytes());
  EXPECT_EQ(detail::memory_of(Part(), nested, Part()), 2000 + of_nested);
}

}  // namespace
}  // namespace thermedge
