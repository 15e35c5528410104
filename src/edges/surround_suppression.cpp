// The half of the oriented filter that compares a response with what lies to both sides.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "float_frame.hpp"
#include "hysteresis.hpp"
#include "oriented_filter_impl.hpp"
#include "oriented_filter_simd.hpp"
#include "suppression_simd.hpp"

namespace thermedge {

// By how much the response of a pixel is over that of both sides; a slope is as strong all over.
float OrientedFilterBank::Impl::suppressed_response_at(int x, int y) const {
  const std::int32_t own = direction(x, y);
  const auto at = [&](int side_x, int side_y) {
    const int turn = std::abs(direction(side_x, side_y) - own);
    return turn <= detail::kLargestTurn || turn >= kEdgeDirections - detail::kLargestTurn
               ? response(side_x, side_y)
               : 0.0F;
  };
  const detail::Across& step = steps[static_cast<std::size_t>(own)];
  const int reach = tuning.side_distances_px[sides - 1];
  const bool inside = x >= reach && y >= reach && x < width - reach && y < height - reach;
  const auto side = [&](std::size_t i, int sign) {
    const int side_x = x + sign * step.side_x[i];
    const int side_y = y + sign * step.side_y[i];
    if (inside || edges.view().contains(side_x, side_y)) {
      return at(side_x, side_y);
    }
    return at(detail::mirrored(side_x, width), detail::mirrored(side_y, height));
  };
  float least = side(0, 1) + side(0, -1);
  for (std::size_t i = 1; i < sides; ++i) {
    least = std::min(least, side(i, 1) + side(i, -1));
  }
  return response(x, y) - 0.5F * least;
}

// The largest response in the square around each pixel; there is none outside the frame.
void OrientedFilterBank::Impl::find_largest(ParallelRunner& runner) {
  const int reach = tuning.ripple_reach_px;
  const int taps = 2 * reach + 1;
  for_each_band(runner, [&](int band, int y_begin, int y_end) {
    float* padded_row = scratch.row(2 * band);
    for (int y = y_begin; y < y_end; ++y) {
      std::fill_n(padded_row, scratch.width(), 0.0F);
      std::copy_n(response.row(y), width, padded_row + reach);
      detail::largest_row(padded_row, 1, taps, width, largest_in_row.row(y + reach));
    }
  });
  for_each_band(runner, [&](int, int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y) {
      detail::largest_row(largest_in_row.row(y), largest_in_row.stride(), taps, width,
                          largest_around.row(y));
    }
  });
}

// Sets the suppressed_response and the class, before hysteresis, of a pixel on a ridge.
void OrientedFilterBank::Impl::classify(int x, int y, float over) {
  if (over < static_cast<float>(tuning.least_sharpness) * response(x, y)) {
    over = 0;
  }
  const float ripple = static_cast<float>(tuning.ripple_share) * largest_around(x, y);
  over /= std::sqrt(1 + ripple * ripple);
  suppressed_response(x, y) = over;
  edges(x, y) = over > static_cast<float>(options.high)  ? detail::kStrongEdge
                : over > static_cast<float>(options.low) ? detail::kWeakEdge
                                                         : detail::kNoEdge;
}

// Classifies the pixels of row y at these places, in ascending order. Away from the border, where
// nothing is mirrored, all together.
void OrientedFilterBank::Impl::classify_row(int y, std::span<std::int32_t> xs, float* over) {
  const int reach = tuning.side_distances_px[sides - 1];
  const bool inside = y >= reach && y < height - reach;
  const auto begin = std::lower_bound(xs.begin(), xs.end(), inside ? reach : width);
  const auto end = std::lower_bound(begin, xs.end(), width - reach);
  const auto one_by_one = [&](auto from, auto to) {
    for (auto x = from; x != to; ++x) {
      classify(*x, y, suppressed_response_at(*x, y));
    }
  };
  one_by_one(xs.begin(), begin);
  one_by_one(end, xs.end());
  const auto count = static_cast<int>(end - begin);
  if (count == 0) {
    return;
  }
  const std::int32_t* first = xs.data() + (begin - xs.begin());
  detail::suppressed_responses_at(response.row(y), direction.row(y), side_offsets.data(),
                                  static_cast<int>(sides), first, count, over);
  for (int i = 0; i < count; ++i) {
    classify(first[i], y, over[i]);
  }
}

// Where the sides of a pixel lie, in elements from it.
void OrientedFilterBank::Impl::find_side_offsets() {
  for (std::size_t side = 0; side < OrientedFilterTuning::kSides; ++side) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      side_offsets[side * steps.size() + i] = static_cast<std::int32_t>(
          steps[i].side_y[side] * response.stride() + steps[i].side_x[side]);
    }
  }
}

// Leaves in `edges` the class of each pixel before hysteresis.
void OrientedFilterBank::Impl::suppress(int band, int y_begin, int y_end) {
  const auto low = static_cast<float>(options.low);
  const detail::DiagonalShares shares = {steps[0].share, steps[1].share, steps[2].share,
                                         steps[3].share};
  std::int32_t* found = places.row(band);
  for (int y = y_begin; y < y_end; ++y) {
    std::fill_n(edges.row(y), width, detail::kNoEdge);
    std::fill_n(suppressed_response.row(y), width, 0.0F);
    if (y == 0 || y == height - 1 || width < 3) {
      continue;
    }
    const int count = detail::find_ridges_row(response.row(y) + 1, response.stride(),
                                              direction.row(y) + 1, shares, low, width - 2, found);
    std::transform(found, found + count, found, [](std::int32_t x) { return x + 1; });
    // Kernels look at whole vectors.
    std::fill_n(found + count, detail::kFilterSlack, count > 0 ? found[count - 1] : 0);
    classify_row(y, {found, static_cast<std::size_t>(count)}, of_places.row(band));
  }
}

// Near fine edges only they are edges.
void OrientedFilterBank::Impl::merge_fine() {
  constexpr auto kHalfWidths = OrientedFilterTuning::kFineHalfWidthsPx;
  constexpr int kReach = static_cast<int>(kHalfWidths.size() / 2);
  const auto for_each_fine = [&](auto&& task) {
    for (int y = 1; y + 1 < height && width > 2; ++y) {
      std::uint8_t* const row = fine_classes.row(y);
      std::uint8_t* const end = row + width - 1;
      std::uint8_t* at = row + 1;
      while ((at = detail::find_pixel(at, end, detail::kKeptEdge)) != end) {
        task(static_cast<int>(at++ - row), y);
      }
    }
  };
  for_each_fine([&](int x, int y) {
    for (int dy = -kReach; dy <= kReach; ++dy) {
      if (y + dy >= 0 && y + dy < height) {
        const int half = kHalfWidths[static_cast<std::size_t>(dy + kReach)];
        std::fill(edges.row(y + dy) + std::max(x - half, 0),
                  edges.row(y + dy) + std::min(x + half + 1, width), detail::kNoEdge);
      }
    }
  });
  for_each_fine([&](int x, int y) { classify(x, y, suppressed_response_at(x, y)); });
}

}  // namespace thermedge
