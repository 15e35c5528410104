// Matching of edge pixels against all ways to pair them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "thermedge/eval/matching.hpp"

namespace thermedge::eval {
namespace {

std::vector<Pixel> set_pixels(ImageView<const std::uint8_t> map) {
  std::vector<Pixel> pixels;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (map(x, y) != 0) {
        pixels.push_back({x, y});
      }
    }
  }
  return pixels;
}

Image<std::uint8_t> random_map(int width, int height, int percent, std::mt19937& random) {
  Image<std::uint8_t> map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      map(x, y) = static_cast<int>(random() % 100) < percent ? 1 : 0;
    }
  }
  return map;
}

// The most pairs of found[at..] with true pixels that are not taken, by trying all.
std::size_t most_pairs(const std::vector<Pixel>& found, const std::vector<Pixel>& truth,
                       double radius_px, std::size_t at, std::vector<bool>& taken) {
  if (at == found.size()) {
    return 0;
  }
  std::size_t best = most_pairs(found, truth, radius_px, at + 1, taken);
  for (std::size_t t = 0; t < truth.size(); ++t) {
    const double away = std::hypot(found[at].x - truth[t].x, found[at].y - truth[t].y);
    if (!taken[t] && away <= radius_px) {
      taken[t] = true;
      best = std::max(best, 1 + most_pairs(found, truth, radius_px, at + 1, taken));
      taken[t] = false;
    }
  }
  return best;
}

std::size_t most_pairs(const std::vector<Pixel>& found, const std::vector<Pixel>& truth,
                       double radius_px) {
  std::vector<bool> taken(truth.size(), false);
  return most_pairs(found, truth, radius_px, 0, taken);
}

std::vector<std::int32_t> numbers(std::size_t count) {
  std::vector<std::int32_t> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{1, 1}, {1, 7}, {9, 1}, {2, 5}, {3, 3}, {4, 4}, {5, 3}};
constexpr double kRadii[] = {0, 1, 1.5, 2.3, 20};

template <class F>
void for_each_case(F&& check) {
  std::mt19937 random(3);
  for (const Size size : kSizes) {
    for (const double radius_px : kRadii) {
      for (const int percent : {0, 25, 40}) {
        for (int repeat = 0; repeat < 6; ++repeat) {
          const auto found = random_map(size.width, size.height, percent, random);
          const auto truth = random_map(size.width, size.height, 35, random);
          const auto pixels = set_pixels(found);
          if (pixels.size() <= 6) {  // else there are too many ways to try
            check(pixels, truth.view(), radius_px);
          }
        }
      }
    }
  }
}

TEST(Matching, IsAsLargeAsAnyOtherOne) {
  for_each_case([](const std::vector<Pixel>& found, ImageView<const std::uint8_t> truth,
                   double radius_px) {
    const MatchGraph graph(found, truth, radius_px);
    ASSERT_EQ(graph.found_count(), found.size());
    PixelMatcher matcher(graph);
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {  // the second time: a part
      std::vector<std::int32_t> chosen = numbers(found.size());
      chosen.erase(chosen.begin(),
                   chosen.begin() + static_cast<std::ptrdiff_t>(std::min(first, chosen.size())));
      std::vector<Pixel> part;
      for (const std::int32_t i : chosen) {
        part.push_back(found[static_cast<std::size_t>(i)]);
      }
      const std::size_t pairs = matcher.match(chosen);
      EXPECT_EQ(pairs, most_pairs(part, set_pixels(truth), radius_px));
      EXPECT_EQ(
          static_cast<std::size_t>(std::count_if(
              chosen.begin(), chosen.end(), [&](std::int32_t i) { return matcher.is_matched(i); })),
          pairs);
    }
  });
}

TEST(Matching, InOrderIsLargestForEveryBeginning) {
  std::mt19937 random(8);
  for_each_case(
      [&](const std::vector<Pixel>& found, ImageView<const std::uint8_t> truth, double radius_px) {
        std::vector<std::int32_t> order = numbers(found.size());
        std::shuffle(order.begin(), order.end(), random);
        const auto gains = match_in_order(MatchGraph(found, truth, radius_px), order);
        std::vector<Pixel> beginning;
        std::vector<Pixel> flagged;
        std::size_t sum = 0;
        for (std::size_t i = 0; i < order.size(); ++i) {
          beginning.push_back(found[static_cast<std::size_t>(order[i])]);
          if (gains[i] != 0) {
            flagged.push_back(beginning.back());
            ++sum;
          }
          EXPECT_EQ(sum, most_pairs(beginning, set_pixels(truth), radius_px));
          EXPECT_EQ(most_pairs(flagged, set_pixels(truth), radius_px), flagged.size());
        }
      });
}

// Two true pixels 0 and 2, found 1 and 2 with reach 1: greedy pairing 2-2 leaves 1-0.
TEST(Matching, FormsPairsNearestFirst) {
  Image<std::uint8_t> truth(5, 1);
  fill_pixels(truth.view(), std::uint8_t{0});
  truth(2, 0) = 1;
  const MatchGraph graph(std::vector<Pixel>{{1, 0}, {2, 0}, {3, 0}}, truth.view(), 1);
  PixelMatcher matcher(graph);
  EXPECT_EQ(matcher.match(numbers(3)), 1U);
  EXPECT_FALSE(matcher.is_matched(0));
  EXPECT_TRUE(matcher.is_matched(1));
  EXPECT_FALSE(matcher.is_matched(2));
}

// A row of true pixels shifted by one: each of the long chain has to give way.
TEST(Matching, GivesWayAlongLongChains) {
  constexpr int kLength = 300;
  Image<std::uint8_t> truth(kLength + 1, 1);
  fill_pixels(truth.view(), std::uint8_t{1});
  truth(kLength, 0) = 0;
  std::vector<Pixel> found;
  for (int x = 1; x <= kLength; ++x) {
    found.push_back({x, 0});
  }
  const MatchGraph graph(found, truth.view(), 1);
  EXPECT_EQ(PixelMatcher(graph).match(numbers(found.size())), found.size());
  const auto gains = match_in_order(graph, numbers(found.size()));
  EXPECT_EQ(std::count(gains.begin(), gains.end(), 1), kLength);
}

}  // namespace
}  // namespace thermedge::eval
