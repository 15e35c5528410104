#include "thermedge/stages/bad_pixels.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "outliers_simd.hpp"

namespace thermedge {
namespace {

using Frame = ImageView<const std::uint16_t>;

// Some of the pixels of a 5x5 neighbourhood.
class Values {
 public:
  void add(int value) {
    values_[count_++] = value;
    second_largest_ = std::max(second_largest_, std::min(largest_, value));
    largest_ = std::max(largest_, value);
    second_smallest_ = std::min(second_smallest_, std::max(smallest_, value));
    smallest_ = std::min(smallest_, value);
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] int smallest() const { return smallest_; }
  [[nodiscard]] int largest() const { return largest_; }
  [[nodiscard]] int second_smallest() const { return second_smallest_; }  // of two or more
  [[nodiscard]] int second_largest() const { return second_largest_; }
  [[nodiscard]] int median() const {
    std::array<int, kMost> sorted = values_;
    std::sort(sorted.begin(), sorted.begin() + count_);
    return (sorted[(count_ - 1) / 2] + sorted[count_ / 2]) / 2;
  }

 private:
  static constexpr std::size_t kMost = 25;
  std::array<int, kMost> values_{};
  std::size_t count_ = 0;
  int smallest_ = std::numeric_limits<int>::max();
  int second_smallest_ = std::numeric_limits<int>::max();
  int largest_ = std::numeric_limits<int>::min();
  int second_largest_ = std::numeric_limits<int>::min();
};

// The pixels within the frame that lie `radius` columns or rows away from the block of `side` x
// `side` pixels from (x, y) on and fulfil `is_good(x, y)`.
template <class F>
Values ring(Frame frame, int x, int y, int radius, F&& is_good, int side = 1) {
  Values values;
  const int last = radius + side - 1;
  for (int j = y - radius; j <= y + last; ++j) {
    const bool whole_row = j == y - radius || j == y + last;
    for (int i = x - radius; i <= x + last; i += whole_row ? 1 : radius + last) {
      if (frame.contains(i, j) && is_good(i, j)) {
        values.add(frame(i, j));
      }
    }
  }
  return values;
}

Values ring(Frame frame, int x, int y, int radius, int side = 1) {
  return ring(
      frame, x, y, radius, [](int, int) { return true; }, side);
}

// How far a pixel or block lies above and below its neighbours, counts.
struct Excess {
  int above = 0;
  int below = 0;
};

// What neighbours have, counts.
struct Span {
  int low = 0;
  int high = 0;
};

// Whether it lies farther off than optics allow, given what its neighbours stand out of the pixels
// around them. On the border, where one side is hidden, the flank of a point can look like a dead
// pixel beside a hollow; the surroundings show that there is something.
bool stands_out(Excess excess, Span neighbours, const Values& surroundings, bool all_seen,
                int limit, int optics_ratio) {
  const int contrast = all_seen ? 0 : surroundings.largest() - surroundings.smallest();
  const int hill = std::max(neighbours.high - surroundings.median(), contrast);
  const int hollow = std::max(surroundings.median() - neighbours.low, contrast);
  return excess.above > limit + optics_ratio * hill || excess.below > limit + optics_ratio * hollow;
}

// The rule for dead pixels in full; slow, so only the pixels that pass the noise test get here.
bool is_dead(Frame frame, int x, int y, int limit, int optics_ratio) {
  const Values neighbours = ring(frame, x, y, 1);
  const int above = frame(x, y) - neighbours.second_largest();
  const int below = neighbours.second_smallest() - frame(x, y);
  if (std::max(above, below) <= limit) {
    return false;  // whatever the surroundings are like
  }
  return stands_out({above, below}, {neighbours.second_smallest(), neighbours.second_largest()},
                    ring(frame, x, y, 2), neighbours.size() == 8, limit, optics_ratio);
}

// The same for the block of 2x2 pixels from (x, y) on.
bool is_dead_block(Frame frame, int x, int y, int limit, int optics_ratio) {
  const auto [least, largest] =
      std::minmax({frame(x, y), frame(x + 1, y), frame(x, y + 1), frame(x + 1, y + 1)});
  const Values neighbours = ring(frame, x, y, 1, 2);
  const int above = least - neighbours.largest();
  const int below = neighbours.smallest() - largest;
  if (std::max(above, below) <= limit) {
    return false;
  }
  return stands_out({above, below}, {neighbours.smallest(), neighbours.largest()},
                    ring(frame, x, y, 2, 2), neighbours.size() == 12, limit, optics_ratio);
}

bool is_before(const BadPixel& a, const BadPixel& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

// Adds the pixels of dead blocks to `dead`, which stays in order and without repetitions.
void find_bad_blocks(Frame frame, int limit, int optics_ratio, std::vector<BadPixel>& dead) {
  const std::size_t singles = dead.size();
  const auto look_at = [&](int x, int y) {
    if (is_dead_block(frame, x, y, limit, optics_ratio)) {
      dead.insert(dead.end(), {{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}});
    }
  };
  const int right = frame.width() - 2;  // columns and rows of the last blocks
  const int bottom = frame.height() - 2;
  for (int y = 0; y <= bottom; ++y) {
    const bool is_whole = y == 0 || y == bottom ||
                          detail::any_block_stands_out(
                              {frame.row(y - 1), frame.row(y), frame.row(y + 1), frame.row(y + 2)},
                              frame.width(), limit);
    for (int x = 0; x <= right; x += is_whole ? 1 : right) {
      look_at(x, y);
    }
  }
  if (dead.size() > singles) {
    std::sort(dead.begin(), dead.end(), is_before);
    dead.erase(std::unique(dead.begin(), dead.end()), dead.end());
  }
}

int limit_counts(double sigma_counts, const BadPixelOptions& options,
                 const BadPixelTuning& tuning) {
  const double limit = std::max(sigma_counts, tuning.least_sigma_counts) * options.threshold_sigmas;
  constexpr double kLargest = std::numeric_limits<std::uint16_t>::max();
  return static_cast<int>(std::clamp(limit, 0.0, kLargest));
}

// Collects candidates, all pixels of the border among them, then drops those that are none.
void find_bad_pixels(Frame frame, int limit, int optics_ratio, std::vector<BadPixel>& dead) {
  const int width = frame.width();
  const int height = frame.height();
  for (int y = 0; y < height; ++y) {
    if (y == 0 || y == height - 1) {
      for (int x = 0; x < width; ++x) {
        dead.push_back({x, y});
      }
      continue;
    }
    dead.push_back({0, y});
    detail::append_outliers({frame.row(y - 1), frame.row(y), frame.row(y + 1)}, width, y, limit,
                            dead);
    dead.push_back({width - 1, y});
  }
  std::erase_if(
      dead, [&](BadPixel pixel) { return !is_dead(frame, pixel.x, pixel.y, limit, optics_ratio); });
}

bool contains(const std::vector<BadPixel>& dead, int x, int y) {
  return std::binary_search(dead.begin(), dead.end(), BadPixel{x, y}, is_before);
}

}  // namespace

Status BadPixelOptions::check() const { return check_ranges(*this, "bad_pixels."); }

void replace_bad_pixels(ImageView<std::uint16_t> frame, double sigma_counts,
                        const BadPixelOptions& options, std::vector<BadPixel>& dead,
                        const BadPixelTuning& tuning) {
  dead.clear();
  if (std::min(frame.width(), frame.height()) < tuning.smallest_side_px) {
    return;
  }
  const int limit = limit_counts(sigma_counts, options, tuning);
  find_bad_pixels(frame, limit, tuning.optics_ratio, dead);
  find_bad_blocks(frame, limit, tuning.block_optics_ratio, dead);
  const auto is_good = [&](int x, int y) { return !contains(dead, x, y); };
  for (const BadPixel& pixel : dead) {
    Values values = ring(frame, pixel.x, pixel.y, 1, is_good);
    if (values.empty()) {
      values = ring(frame, pixel.x, pixel.y, 2, is_good);
    }
    if (!values.empty()) {
      frame(pixel.x, pixel.y) = static_cast<std::uint16_t>(values.median());
    }
  }
}

}  // namespace thermedge
