// Thinning against its definition on every small map.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "support/images.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/eval/thinning.hpp"

namespace thermedge::eval {
namespace {

using Map = Image<std::uint8_t>;

// x1..x8 of Lam, Lee & Suen: east, then counter-clockwise; x[0] is x8, x[9] is x1.
std::array<bool, 10> neighbours(ImageView<const std::uint8_t> map, int x, int y) {
  constexpr int kDx[] = {1, 1, 0, -1, -1, -1, 0, 1};
  constexpr int kDy[] = {0, -1, -1, -1, 0, 1, 1, 1};
  std::array<bool, 10> n{};
  for (int k = 0; k < 8; ++k) {
    const int u = x + kDx[k];
    const int v = y + kDy[k];
    n[static_cast<std::size_t>(k + 1)] = map.contains(u, v) && map(u, v) != 0;
  }
  n[0] = n[8];
  n[9] = n[1];
  return n;
}

int crossing_number(const std::array<bool, 10>& x) {
  int count = 0;
  for (std::size_t i = 1; i <= 4; ++i) {
    count += !x[2 * i - 1] && (x[2 * i] || x[2 * i + 1]) ? 1 : 0;
  }
  return count;
}

bool goes(const std::array<bool, 10>& x, bool first_pass) {
  int n1 = 0;
  int n2 = 0;
  for (std::size_t k = 1; k <= 4; ++k) {
    n1 += x[2 * k - 1] || x[2 * k] ? 1 : 0;
    n2 += x[2 * k] || x[2 * k + 1] ? 1 : 0;
  }
  const bool g3 = first_pass ? (x[2] || x[3] || !x[8]) && x[1] : (x[6] || x[7] || !x[4]) && x[5];
  return crossing_number(x) == 1 && std::min(n1, n2) >= 2 && std::min(n1, n2) <= 3 && !g3;
}

void thin_by_definition(Map& map) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const bool first_pass : {true, false}) {
      Map next = map.clone();
      for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
          if (map(x, y) != 0 && goes(neighbours(map, x, y), first_pass)) {
            next(x, y) = 0;
            changed = true;
          }
        }
      }
      map = std::move(next);
    }
  }
}

Map map_of_bits(int width, int height, unsigned bits) {
  Map map(width, height);
  for (int i = 0; i < width * height; ++i) {
    map(i % width, i / width) = bits >> i & 1;
  }
  return map;
}

Map blobs(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Map map(width, height);
  fill_pixels(map.view(), std::uint8_t{0});
  for (int i = 0; i < 12; ++i) {
    const int cx = static_cast<int>(random() % static_cast<unsigned>(width));
    const int cy = static_cast<int>(random() % static_cast<unsigned>(height));
    const int r = 1 + static_cast<int>(random() % 7);
    const auto value = static_cast<std::uint8_t>(1 + random() % 255);
    for (int y = std::max(0, cy - r); y < std::min(height, cy + r); ++y) {
      for (int x = std::max(0, cx - r); x < std::min(width, cx + 2 * r); ++x) {
        map(x, y) = std::max(map(x, y), value);
      }
    }
  }
  return map;
}

TEST(Thinning, FollowsItsDefinitionOnEverySmallMap) {
  for (const auto& [width, height] : {std::pair{4, 3}, {3, 4}, {12, 1}, {1, 12}, {2, 6}}) {
    for (unsigned bits = 0; bits < 1U << 12; ++bits) {
      Map map = map_of_bits(width, height, bits);
      Map expected = map.clone();
      thin(map);
      thin_by_definition(expected);
      ASSERT_TRUE(test::same_pixels<std::uint8_t>(map.view(), expected.view()))
          << width << "x" << height << " bits " << bits;
    }
  }
}

TEST(Thinning, FollowsItsDefinitionOnBlobs) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Map map = blobs(41, 37, seed);
    Map expected(41, 37);
    std::transform(map.row(0), map.row(0) + 1, expected.row(0), [](auto v) { return v; });
    for (int y = 0; y < 37; ++y) {
      for (int x = 0; x < 41; ++x) {
        expected(x, y) = map(x, y) != 0 ? 1 : 0;
      }
    }
    thin(map);
    thin_by_definition(expected);
    ASSERT_TRUE(test::same_pixels<std::uint8_t>(map.view(), expected.view())) << "seed " << seed;
  }
}

TEST(Thinning, KeepsConnectionsAndStopsThere) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Map map = blobs(50, 40, seed);
    const auto before = count_fragments(map.view());
    thin(map);
    const auto after = count_fragments(map.view());
    EXPECT_EQ(after.fragments, before.fragments);
    EXPECT_LT(after.edge_pixels, before.edge_pixels);
    Map again = map.clone();
    thin(again);
    EXPECT_TRUE(test::same_pixels<std::uint8_t>(again.view(), map.view()));
  }
}

TEST(NestedThinning, KeepsStrengthsAndConnections) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Map original = blobs(50, 40, seed);
    Map map = original.clone();
    thin_nested(map);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        if (map(x, y) != 0) {
          EXPECT_EQ(map(x, y), original(x, y));
          const auto n = neighbours(map, x, y);
          const auto set = std::count(n.begin() + 1, n.begin() + 9, true);
          EXPECT_FALSE(set >= 2 && crossing_number(n) == 1) << "could go: " << x << ", " << y;
        }
      }
    }
    EXPECT_EQ(count_fragments(map.view()).fragments, count_fragments(original.view()).fragments);
  }
}

// A ridge of three columns: the middle one is the strongest and stays.
TEST(NestedThinning, LeavesTheStrongest) {
  Map map(5, 7);
  fill_pixels(map.view(), std::uint8_t{0});
  for (int y = 0; y < 7; ++y) {
    map(1, y) = 10;
    map(2, y) = 200;
    map(3, y) = 20;
  }
  thin_nested(map);
  for (int y = 1; y < 6; ++y) {
    EXPECT_EQ(map(1, y), 0);
    EXPECT_EQ(map(2, y), 200);
    EXPECT_EQ(map(3, y), 0);
  }
}

}  // namespace
}  // namespace thermedge::eval
