#include "thermedge/stages/validity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>

#include "order_statistics.hpp"

namespace thermedge {
namespace {

constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Calls visit(x, y) for the pixels inside a picture of this size that touch (x, y) with a side.
template <class F>
void for_each_neighbour(int x, int y, int width, int height, F&& visit) {
  if (x > 0) {
    visit(x - 1, y);
  }
  if (x + 1 < width) {
    visit(x + 1, y);
  }
  if (y > 0) {
    visit(x, y - 1);
  }
  if (y + 1 < height) {
    visit(x, y + 1);
  }
}

// A share of 1 of `number`, compared without rounding errors that matter.
bool is_share(std::int64_t part, std::int64_t number, double share) {
  return number > 0 && static_cast<double>(part) >= share * static_cast<double>(number);
}

}  // namespace

// Rows of the frame, or its columns, as lines 0 .. count - 1 of pixels 0 .. length - 1.
struct InvalidFinder::Lines {
  ImageView<std::uint16_t> counts;
  bool are_columns;
  int count, length;
  std::span<const std::uint32_t> sums, equals;

  [[nodiscard]] std::uint16_t& at(int line, int i) const {
    return are_columns ? counts(line, i) : counts(i, line);
  }
  [[nodiscard]] int difference(int line, int other, int i) const {
    return int{at(line, i)} - int{at(other, i)};
  }
  void mark(int line, int first, int last, ImageView<std::uint8_t> valid) const {
    for (int i = first; i <= last; ++i) {
      (are_columns ? valid(line, i) : valid(i, line)) = 0;
    }
  }
};

Status ValidityOptions::check() const { return check_ranges(*this, "validity."); }

void InvalidFinder::prepare(int width, int height) {
  if (marks_.width() == width && marks_.height() == height) {
    return;
  }
  marks_.resize(width, height);
  before_.resize(width, height);
  fill_pixels(marks_.view(), std::uint8_t{0});
  area_.reserve(marks_.size());
  area_rows_.resize(index(height));
  area_columns_.resize(index(width));
  row_sums_.resize(index(height));
  row_equals_.resize(index(height));
  column_sums_.resize(index(width));
  column_equals_.resize(index(width));
  sample_.reserve(marks_.size() / 4 + index(2 * (width + height)));
  blocks_.reserve(index(tuning_.most_blocks) + 1);
  row_runs_.reserve(index(height));
  column_runs_.reserve(index(width));
}

void InvalidFinder::run(ImageView<std::uint16_t> counts, ImageView<std::uint8_t> valid,
                        InvalidPixels& invalid) {
  const int width = counts.width();
  const int height = counts.height();
  if (std::min(width, height) < tuning_.smallest_side_px) {
    return;
  }
  prepare(width, height);
  measure(counts);
  measure_differences(counts);
  if (equal_share_ > tuning_.most_equal_share) {
    return;
  }
  find_border_areas(counts, valid);
  find_blocks(counts, valid);
  const Lines rows{counts, false, height, width, row_sums_, row_equals_};
  const Lines columns{counts, true, width, height, column_sums_, column_equals_};
  // Of both before any is replaced, so that it does not matter which come first.
  find_dead_lines(rows, row_runs_);
  find_dead_lines(columns, column_runs_);
  // Twice, as what a line was first replaced by may be of a dead one that crosses it.
  for (int round = 0; round < 2 && row_runs_.size() + column_runs_.size() > 0; ++round) {
    copy_pixels(ImageView<const std::uint16_t>(counts), before_.view());
    const Lines old_rows{before_, false, height, width, row_sums_, row_equals_};
    const Lines old_columns{before_, true, width, height, column_sums_, column_equals_};
    invalid.dead_rows = replace(rows, old_rows, row_runs_, valid);
    invalid.dead_columns = replace(columns, old_columns, column_runs_, valid);
    replace_crossings(counts);
  }
  find_border_lines(rows, valid);
  find_border_lines(columns, valid);
}

void InvalidFinder::measure(ImageView<const std::uint16_t> counts) {
  const int width = counts.width();
  std::uint16_t low = 0xFFFF;
  std::uint16_t high = 0;
  std::uint32_t* column_sums = column_sums_.data();
  std::uint32_t* column_equals = column_equals_.data();
  std::fill(column_sums_.begin(), column_sums_.end(), 0U);
  std::fill(column_equals_.begin(), column_equals_.end(), 0U);
  for (int y = 0; y < counts.height(); ++y) {
    const std::uint16_t* row = counts.row(y);
    for (int x = 0; x < width; ++x) {
      low = std::min(low, row[x]);
      high = std::max(high, row[x]);
    }
    std::uint32_t sum = 0;
    std::uint32_t equals = 0;
    for (int x = 0; x < width; ++x) {
      sum += row[x];
      column_sums[x] += row[x];
    }
    for (int x = 0; x + 1 < width; ++x) {
      equals += row[x] == row[x + 1] ? 1U : 0U;
    }
    row_sums_[index(y)] = sum;
    row_equals_[index(y)] = equals;
    if (y > 0) {
      const std::uint16_t* above = counts.row(y - 1);
      for (int x = 0; x < width; ++x) {
        column_equals[x] += row[x] == above[x] ? 1U : 0U;
      }
    }
  }
  low_ = low;
  high_ = high;
}

// Differences of neighbours over some rows and columns, the same ones from either side. Pixels at
// the smallest and largest value are left out: clipped areas and black corners say nothing about
// how the rest came to be.
void InvalidFinder::measure_differences(ImageView<const std::uint16_t> counts) {
  const auto is_sampled = [&](int i, int size) {
    const int step = tuning_.sample_step_px;
    return std::min(i, size - 1 - i) % step == step / 2;
  };
  const auto take = [&](int a, int b) {
    if (a != low_ && a != high_ && b != low_ && b != high_) {
      sample_.push_back(std::abs(a - b));
    }
  };
  sample_.clear();
  for (int y = 0; y < counts.height(); ++y) {
    if (is_sampled(y, counts.height())) {
      const std::uint16_t* row = counts.row(y);
      for (int x = 0; x + 1 < counts.width(); ++x) {
        take(row[x], row[x + 1]);
      }
    }
  }
  for (int x = 0; x < counts.width(); ++x) {
    if (is_sampled(x, counts.width())) {
      for (int y = 0; y + 1 < counts.height(); ++y) {
        take(counts(x, y), counts(x, y + 1));
      }
    }
  }
  equal_share_ = 1;
  usual_jump_counts_ = 0;
  if (!sample_.empty()) {
    const auto equals = std::count(sample_.begin(), sample_.end(), 0);
    equal_share_ = static_cast<double>(equals) / static_cast<double>(sample_.size());
    usual_jump_counts_ = detail::nth_value(std::span(sample_), (sample_.size() - 1) / 2);
  }
  far_counts_ = tuning_.jump_factor * usual_jump_counts_ + tuning_.least_jump_counts;
}

// From the corners, and from the middle of each side, as half of a side holds its middle.
void InvalidFinder::find_border_areas(ImageView<const std::uint16_t> counts,
                                      ImageView<std::uint8_t> valid) {
  const int right = counts.width() - 1;
  const int bottom = counts.height() - 1;
  const std::array seeds = {Pixel{0, 0},
                            Pixel{right, 0},
                            Pixel{0, bottom},
                            Pixel{right, bottom},
                            Pixel{right / 2, 0},
                            Pixel{right / 2, bottom},
                            Pixel{0, bottom / 2},
                            Pixel{right, bottom / 2},
                            Pixel{(right + 1) / 2, 0},
                            Pixel{(right + 1) / 2, bottom},
                            Pixel{0, (bottom + 1) / 2},
                            Pixel{right, (bottom + 1) / 2}};
  area_.clear();
  for (const Pixel& seed : seeds) {
    if (counts(seed.x, seed.y) == low_ && marks_(seed.x, seed.y) == 0) {
      const std::size_t before = area_.size();
      if (!grow_area(counts, seed)) {
        forget_area(before);
      }
    }
  }
  const bool is_most = is_share(static_cast<std::int64_t>(area_.size()),
                                static_cast<std::int64_t>(counts.size()), tuning_.most_area_share);
  if (!is_most) {
    for (const Pixel& at : area_) {
      for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, bottom); ++y) {
        for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, right); ++x) {
          valid(x, y) = 0;
        }
      }
    }
  }
  forget_area(0);
}

void InvalidFinder::forget_area(std::size_t from) {
  for (std::size_t i = from; i < area_.size(); ++i) {
    marks_(area_[i].x, area_[i].y) = 0;
  }
  area_.resize(from);
}

// Adds the area of smallest values around `seed` to area_ and says whether it is one that no scene
// makes. Gives up early where the outline gets longer than one that is allowed.
bool InvalidFinder::grow_area(ImageView<const std::uint16_t> counts, Pixel seed) {
  const int width = counts.width();
  const int height = counts.height();
  const auto most_outline =
      static_cast<std::int64_t>((2 + 2 * tuning_.rough_outline_share) * (width + height));
  const std::size_t first = area_.size();
  std::fill(area_rows_.begin(), area_rows_.end(), 0);
  std::fill(area_columns_.begin(), area_columns_.end(), 0);
  std::int64_t outline = 0;
  std::int64_t jumps = 0;
  marks_(seed.x, seed.y) = 1;
  area_.push_back(seed);
  for (std::size_t i = first; i < area_.size() && outline <= most_outline; ++i) {
    const Pixel at = area_[i];
    for_each_neighbour(at.x, at.y, width, height, [&](int x, int y) {
      if (counts(x, y) != low_) {
        ++outline;
        jumps += counts(x, y) - low_ >= far_counts_ ? 1 : 0;
        ++(y == at.y ? area_rows_[index(y)] : area_columns_[index(x)]);
      } else if (marks_(x, y) == 0) {
        marks_(x, y) = 1;
        area_.push_back({x, y});
      }
    });
  }
  if (outline > most_outline || area_.size() - first < index(tuning_.least_area_px) ||
      !is_share(jumps, outline, tuning_.jump_share)) {
    return false;
  }
  constexpr int kMostCrossings = 2;
  std::int64_t back = 0;
  for (const std::vector<int>* crossings : {&area_rows_, &area_columns_}) {
    for (const int number : *crossings) {
      back += std::max(number - kMostCrossings, 0);
    }
  }
  return !is_share(back, outline, tuning_.rough_outline_share) &&
         fills_border(std::span(area_).subspan(first));
}

// Whether an area holds a corner of the frame or half of one of its sides.
bool InvalidFinder::fills_border(std::span<const Pixel> area) const {
  const int right = marks_.width() - 1;
  const int bottom = marks_.height() - 1;
  std::array<int, 4> on_sides{};
  bool holds_corner = false;
  for (const Pixel& at : area) {
    const std::array is_on = {at.y == 0, at.y == bottom, at.x == 0, at.x == right};
    for (std::size_t i = 0; i < is_on.size(); ++i) {
      on_sides[i] += is_on[i] ? 1 : 0;
    }
    holds_corner = holds_corner || ((is_on[0] || is_on[1]) && (is_on[2] || is_on[3]));
  }
  return holds_corner || 2 * std::max(on_sides[0], on_sides[1]) > right ||
         2 * std::max(on_sides[2], on_sides[3]) > bottom;
}

void InvalidFinder::find_border_lines(const Lines& lines, ImageView<std::uint8_t> valid) {
  for (const bool from_end : {false, true}) {
    const int number = std::max(bar_lines(lines, from_end), telemetry_lines(lines, from_end));
    for (int k = 0; k < number; ++k) {
      lines.mark(from_end ? lines.count - 1 - k : k, 0, lines.length - 1, valid);
    }
  }
}

// Where a dead row and a dead column cross, the mean of the four pixels alive around, whichever of
// the two was replaced first.
void InvalidFinder::replace_crossings(ImageView<std::uint16_t> counts) const {
  const auto crosses = [](const Run& run, int line) {
    return run.first <= line && line <= run.last;
  };
  for (const Run& row : row_runs_) {
    for (const Run& column : column_runs_) {
      if (crosses(row, column.line) && crosses(column, row.line) &&
          std::min(row.before, column.before) >= 0 && row.after < counts.height() &&
          column.after < counts.width()) {
        const int sum = counts(column.before, row.before) + counts(column.after, row.before) +
                        counts(column.before, row.after) + counts(column.after, row.after);
        counts(column.line, row.line) = static_cast<std::uint16_t>((sum + 2) / 4);
      }
    }
  }
}

// Lines of one value each from the border on, and the line that is mixed with them. The first line
// of the picture itself has hardly any pixel of that value.
int InvalidFinder::bar_lines(const Lines& lines, bool from_end) const {
  const auto line = [&](int k) { return from_end ? lines.count - 1 - k : k; };
  const auto length = static_cast<std::uint32_t>(lines.length);
  int number = 0;
  while (2 * number < lines.count && lines.equals[index(line(number))] == length - 1) {
    ++number;
  }
  if (number == 0 || 2 * number >= lines.count || 2 * lines.equals[index(line(number))] >= length) {
    return 0;
  }
  const int value = lines.at(line(number - 1), 0);
  int far = 0;
  for (int i = 0; i < lines.length; ++i) {
    far += std::abs(lines.at(line(number), i) - value) >= far_counts_ ? 1 : 0;
  }
  return is_share(far, lines.length, tuning_.jump_share) ? number + 1 : 0;
}

// Lines that differ far from the next one, and along which neighbours differ as those of the
// picture do not. Of the first line alone the difference tells, where it is larger than the flank
// of a step outside would make it.
int InvalidFinder::telemetry_lines(const Lines& lines, bool from_end) {
  if (usual_jump_counts_ == 0) {
    return 0;
  }
  const auto line = [&](int k) { return from_end ? lines.count - 1 - k : k; };
  const auto median = [&](int number, auto&& difference) {
    sample_.clear();
    for (int i = 0; i < number; ++i) {
      sample_.push_back(std::abs(difference(i)));
    }
    return detail::nth_value(std::span(sample_), (sample_.size() - 1) / 2);
  };
  const auto jump = [&](int k) {  // between line k and the next one inwards
    return median(lines.length, [&](int i) { return lines.difference(line(k), line(k + 1), i); });
  };
  const auto is_strange = [&](int k) {
    const int along = median(lines.length - 1, [&](int i) {
      return int{lines.at(line(k), i)} - int{lines.at(line(k), i + 1)};
    });
    return 4 * along <= usual_jump_counts_ || along >= far_counts_;
  };
  int inner = jump(tuning_.most_telemetry_lines);
  for (int k = tuning_.most_telemetry_lines - 1; k >= 0; --k) {
    const int here = jump(k);
    if (here > far_counts_ && here > tuning_.step_ratio * inner && is_strange(k)) {
      return k + 1;
    }
    if (k == 0 && here > far_counts_ && here > tuning_.flank_ratio * inner) {
      return 1;
    }
    inner = here;
  }
  return 0;
}

// Neighbours that are equal along a dead line are at least half of them, along its neighbours at
// most a quarter.
void InvalidFinder::find_dead_lines(const Lines& lines, std::vector<Run>& runs) const {
  runs.clear();
  const auto equal = [&](int line) { return lines.equals[index(line)]; };
  const auto length = static_cast<std::uint32_t>(lines.length);
  for (int line = 0; line < lines.count; ++line) {
    int end = line;
    while (end < lines.count && 2 * equal(end) + 1 >= length) {
      ++end;
    }
    const int before = line - 1;
    const bool is_alone = (before < 0 || 4 * equal(before) < length) &&
                          (end >= lines.count || 4 * equal(end) < length);
    if (end > line && end - line <= tuning_.most_dead_lines && is_alone) {
      for (int dead = line; dead < end; ++dead) {
        add_constant_run(lines, {dead, 0, 0, before, end}, runs);
      }
    }
    if (end == line && is_far_off(lines, line)) {
      runs.push_back({line, 0, lines.length - 1, line - 1, line + 1});
    }
    line = std::max(end - 1, line);
  }
}

// The longest run of one value, where that is half of the line or more. A run at the smallest or
// largest value may be a thing of the scene that is clipped, which has flanks.
void InvalidFinder::add_constant_run(const Lines& lines, Run run, std::vector<Run>& runs) const {
  int first = 0;
  for (int i = 0; i < lines.length; ++i) {
    if (lines.at(run.line, i) != lines.at(run.line, first)) {
      first = i;
    }
    if (i - first > run.last - run.first) {
      run.first = first;
      run.last = i;
    }
  }
  const int number = run.last - run.first + 1;
  if (2 * number < lines.length) {
    return;
  }
  const int value = lines.at(run.line, run.first);
  if (value == low_ || value == high_) {
    for (const int step : {-1, 1}) {
      const int near = step < 0 ? run.before : run.after;
      const int next = near + step;
      if (next < 0 || next >= lines.count) {
        continue;
      }
      int steep = 0;
      for (int i = run.first; i <= run.last; ++i) {
        steep += is_steep(value, lines.at(near, i), lines.at(next, i)) ? 1 : 0;
      }
      if (!is_share(steep, number, tuning_.jump_share)) {
        return;
      }
    }
  }
  runs.push_back(run);
}

// Steeper from `value` to its neighbour than optics allow, going by the pixel after that.
bool InvalidFinder::is_steep(int value, int near, int next) const {
  return std::abs(near - value) >= far_counts_ + tuning_.optics_ratio * std::abs(near - next);
}

// A single line farther off both neighbours than these are off the next ones: by the means, which
// hardly cost anything, and, of the lines that these leave, in nearly all pixels.
bool InvalidFinder::is_far_off(const Lines& lines, int line) const {
  if (usual_jump_counts_ == 0 || line < 1 || line + 1 >= lines.count) {
    return false;
  }
  const auto sum = [&](int l) { return std::int64_t{lines.sums[index(l)]}; };
  const std::int64_t above = sum(line) - sum(line - 1);
  const std::int64_t below = sum(line) - sum(line + 1);
  // Next to the border the other side alone.
  const int before = std::max(line - 2, 0);
  const int after = std::min(line + 2, lines.count - 1);
  const std::int64_t hill =
      std::max(std::abs(sum(line - 1) - sum(before)), std::abs(sum(line + 1) - sum(after)));
  const std::int64_t least =
      std::int64_t{far_counts_} * lines.length / 2 + tuning_.optics_ratio * hill;
  if (std::max(std::min(above, below), std::min(-above, -below)) < least) {
    return false;
  }
  int off = 0;
  for (int i = 0; i < lines.length; ++i) {
    const int up = lines.difference(line, line - 1, i);
    const int down = lines.difference(line, line + 1, i);
    const int flank = std::max(std::abs(lines.difference(line - 1, before, i)),
                               std::abs(lines.difference(line + 1, after, i)));
    const int height = std::max(std::min(up, down), std::min(-up, -down));
    off += height >= far_counts_ / 2 + tuning_.optics_ratio * flank ? 1 : 0;
  }
  return is_share(off, lines.length, tuning_.jump_share);
}

// Between the lines alive on either side; at the border the line is a hole. Returns how many were
// replaced.
int InvalidFinder::replace(const Lines& lines, const Lines& old, std::span<const Run> runs,
                           ImageView<std::uint8_t> valid) {
  int replaced = 0;
  for (const Run& run : runs) {
    if (run.before < 0 || run.after >= lines.count) {
      lines.mark(run.line, run.first, run.last, valid);
      continue;
    }
    ++replaced;
    const int span = run.after - run.before;
    const int from_before = run.line - run.before;
    for (int i = run.first; i <= run.last; ++i) {
      const int sum =
          (span - from_before) * old.at(run.before, i) + from_before * old.at(run.after, i);
      lines.at(run.line, i) = static_cast<std::uint16_t>((sum + span / 2) / span);
    }
  }
  return replaced;
}

// A block of 4x4 px or more holds a pixel of a grid of 4 px, which has an equal neighbour in its
// row and another in its column.
void InvalidFinder::find_blocks(ImageView<const std::uint16_t> counts,
                                ImageView<std::uint8_t> valid) {
  blocks_.clear();
  if (equal_share_ > tuning_.most_equal_share_of_blocks) {
    return;
  }
  const int step = tuning_.least_block_px;
  const int right = counts.width() - 1;
  const int bottom = counts.height() - 1;
  for (int y = 0; y <= bottom; y += step) {
    const std::uint16_t* row = counts.row(y);
    for (int x = 0; x <= right; x += step) {
      const int value = row[x];
      const bool along = (x > 0 && row[x - 1] == value) || (x < right && row[x + 1] == value);
      if (!along ||
          !((y > 0 && counts(x, y - 1) == value) || (y < bottom && counts(x, y + 1) == value))) {
        continue;
      }
      Block block{x, y, x, y};
      const auto grow = [&](int& place, int direction, int end, auto&& at) {
        const int start = place;
        while (place != end && std::abs(place - start) < tuning_.most_block_px &&
               at(place + direction) == value) {
          place += direction;
        }
      };
      grow(block.left, -1, 0, [&](int u) { return counts(u, y); });
      grow(block.right, 1, right, [&](int u) { return counts(u, y); });
      grow(block.top, -1, 0, [&](int v) { return counts(x, v); });
      grow(block.bottom, 1, bottom, [&](int v) { return counts(x, v); });
      const bool is_new = std::find(blocks_.begin(), blocks_.end(), block) == blocks_.end();
      if (is_new && is_dead_block(counts, block)) {
        blocks_.push_back(block);
        if (static_cast<int>(blocks_.size()) > tuning_.most_blocks) {
          return;
        }
      }
    }
  }
  for (const Block& block : blocks_) {
    fill_pixels(valid.crop(block.left, block.top, block.width(), block.height()), std::uint8_t{0});
  }
}

// All of one value, which none of the pixels around has; these differ among each other, and where
// the value is the smallest or largest one the block has no flanks.
bool InvalidFinder::is_dead_block(ImageView<const std::uint16_t> counts, const Block& block) const {
  const int shorter = std::min(block.width(), block.height());
  const int longer = std::max(block.width(), block.height());
  if (shorter < tuning_.least_block_px || longer > tuning_.most_block_px) {
    return false;
  }
  const int value = counts(block.left, block.top);
  for (int y = block.top; y <= block.bottom; ++y) {
    const std::uint16_t* row = counts.row(y);
    if (!std::all_of(row + block.left, row + block.right + 1,
                     [=](std::uint16_t count) { return count == value; })) {
      return false;
    }
  }
  int around = 0;
  int same = 0;
  int equal = 0;
  int steep = 0;
  // Along one side, of `length` pixels: `at(i, k)` is pixel i of the line `k` pixels outside.
  const auto look_along = [&](int length, auto&& at) {
    for (int i = 0; i < length; ++i) {
      ++around;
      same += at(i, 1) == value ? 1 : 0;
      equal += i > 0 && at(i, 1) == at(i - 1, 1) ? 1 : 0;
      steep += is_steep(value, at(i, 1), at(i, 2)) ? 1 : 0;
    }
  };
  const int left = block.left;
  const int top = block.top;
  const int right = block.right;
  const int bottom = block.bottom;
  int sides = 0;
  if (left >= 2) {
    ++sides;
    look_along(block.height(), [&](int i, int k) { return counts(left - k, top + i); });
  }
  if (right + 2 < counts.width()) {
    ++sides;
    look_along(block.height(), [&](int i, int k) { return counts(right + k, top + i); });
  }
  if (top >= 2) {
    ++sides;
    look_along(block.width(), [&](int i, int k) { return counts(left + i, top - k); });
  }
  if (bottom + 2 < counts.height()) {
    ++sides;
    look_along(block.width(), [&](int i, int k) { return counts(left + i, bottom + k); });
  }
  const bool is_extreme = value == low_ || value == high_;
  return sides >= 2 && same == 0 && 2 * equal < around &&
         (!is_extreme || is_share(steep, around, tuning_.jump_share));
}

}  // namespace thermedge
