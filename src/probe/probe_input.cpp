#include "probe_input.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>

namespace thermedge::detail {
namespace {

using Counts = ImageView<const std::uint16_t>;

int low_byte(int count) { return count & 255; }
int high_byte(int count) { return count >> 8; }

double median_of(std::vector<int>& values) {
  if (values.empty()) {
    return 0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Median of |value(x)| for x in [0, width).
template <class F>
double median_magnitude(int width, F&& value) {
  std::vector<int> values;
  values.reserve(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x) {
    values.push_back(std::abs(value(x)));
  }
  return median_of(values);
}

double jump_between(Counts frame, int row, int other) {
  return median_magnitude(frame.width(), [&](int x) { return frame(x, row) - frame(x, other); });
}

double roughness_of(Counts frame, int row) {
  return median_magnitude(frame.width() - 1,
                          [&](int x) { return frame(x + 1, row) - frame(x, row); });
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Pearson's; 0 where one of them is constant.
template <class T>
double correlation(const std::vector<T>& a, const std::vector<T>& b) {
  const auto mean = [](const std::vector<T>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  const double mean_a = mean(a);
  const double mean_b = mean(b);
  double both = 0, of_a = 0, of_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = static_cast<double>(a[i]) - mean_a;
    const double db = static_cast<double>(b[i]) - mean_b;
    both += da * db;
    of_a += da * da;
    of_b += db * db;
  }
  return of_a > 0 && of_b > 0 ? both / std::sqrt(of_a * of_b) : 0;
}

std::vector<int> row_of(Counts frame, int row) {
  return {frame.row(row), frame.row(row) + frame.width()};
}

bool is_swapped(Counts frame, const InputFaultTuning& tuning) {
  std::int64_t pairs = 0, low = 0, high = 0;
  unsigned bits_set = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x + 1 < frame.width(); ++x) {
      const int a = frame(x, y);
      const int b = frame(x + 1, y);
      bits_set |= static_cast<unsigned>(a);
      pairs += a != b ? 1 : 0;
      low += low_byte(a) != low_byte(b) ? 1 : 0;
      high += high_byte(a) != high_byte(b) ? 1 : 0;
    }
  }
  const bool tells = bits_set != 0 && std::countr_zero(bits_set) < tuning.least_unused_bits;
  const auto all = static_cast<double>(pairs);
  return tells && pairs > 0 &&
         static_cast<double>(low)<tuning.most_low_changes * all&& static_cast<double>(high)> tuning
                 .least_high_changes *
             all;
}

Image<std::uint16_t> with_bytes_swapped(Counts frame) {
  Image<std::uint16_t> swapped(frame.width(), frame.height());
  for (int y = 0; y < frame.height(); ++y) {
    std::transform(frame.row(y), frame.row(y) + frame.width(), swapped.row(y), [](int count) {
      return static_cast<std::uint16_t>(low_byte(count) << 8 | high_byte(count));
    });
  }
  return swapped;
}

// What rows of this frame usually are.
struct UsualRows {
  double jump = 0;       // median over the rows of the median step to the next one; at least 1
  double roughness = 0;  // the same along the row
  double largest_jump = 0;
};

UsualRows usual_rows(Counts frame) {
  std::vector<double> jumps, roughness;
  for (int y = 0; y + 1 < frame.height(); ++y) {
    jumps.push_back(jump_between(frame, y, y + 1));
    roughness.push_back(roughness_of(frame, y));
  }
  const double largest = *std::max_element(jumps.begin(), jumps.end());
  return {std::max(median_of(std::move(jumps)), 1.0),
          std::max(median_of(std::move(roughness)), 1.0), largest};
}

std::size_t distinct_counts(Counts frame) {
  std::vector<bool> seen(65536);
  std::size_t distinct = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      distinct += seen[frame(x, y)] ? 0U : 1U;
      seen[frame(x, y)] = true;
    }
  }
  return distinct;
}

// Means of about 16 x 12 blocks.
std::vector<double> block_means(Counts frame) {
  constexpr int kColumns = 16;
  constexpr int kRows = 12;
  std::vector<double> means;
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      double sum = 0;
      int pixels = 0;
      for (int y = j * frame.height() / kRows; y < (j + 1) * frame.height() / kRows; ++y) {
        for (int x = i * frame.width() / kColumns; x < (i + 1) * frame.width() / kColumns; ++x) {
          sum += frame(x, y);
          ++pixels;
        }
      }
      means.push_back(pixels > 0 ? sum / pixels : 0);
    }
  }
  return means;
}

// The half with the counts: of a view in colours neighbours differ much, and one of 8 bits has few
// values.
FrameFaults::Double half_with_counts(Counts top, Counts bottom) {
  constexpr double kMuchRougher = 4;
  constexpr double kManyMoreValues = 1.5;
  const auto values_top = static_cast<double>(distinct_counts(top));
  const auto values_bottom = static_cast<double>(distinct_counts(bottom));
  // In units of the range, of which the number of values is a measure.
  const double rough_top = usual_rows(top).roughness / values_top;
  const double rough_bottom = usual_rows(bottom).roughness / values_bottom;
  if (rough_bottom > kMuchRougher * rough_top) {
    return FrameFaults::Double::kUseTop;
  }
  const bool top_is_rough = rough_top > kMuchRougher * rough_bottom;
  return !top_is_rough && values_top > kManyMoreValues * values_bottom
             ? FrameFaults::Double::kUseTop
             : FrameFaults::Double::kUseBottom;
}

FrameFaults::Double double_picture(Counts frame, const UsualRows& usual,
                                   const InputFaultTuning& tuning) {
  const int middle = frame.height() / 2;
  if (frame.height() % 2 != 0 || middle < tuning.smallest_side_px) {
    return FrameFaults::Double::kNo;
  }
  const double seam = jump_between(frame, middle - 1, middle);
  if (seam <= tuning.seam_jump * usual.jump) {
    return FrameFaults::Double::kNo;
  }
  const Counts top = frame.crop(0, 0, frame.width(), middle);
  const Counts bottom = frame.crop(0, middle, frame.width(), middle);
  const double likeness = correlation(block_means(top), block_means(bottom));
  // Halves of the shapes of sensors, 5:4 to 4:3, in a frame that is higher than wide.
  const double shape = static_cast<double>(frame.width()) / middle;
  const bool is_sensor = frame.height() > frame.width() && shape > 1.2 && shape < 1.4;
  const bool is_largest = seam >= usual.largest_jump;
  const bool is_double = likeness > tuning.sure_likeness ||
                         (is_largest && (likeness > tuning.least_likeness || is_sensor));
  return is_double ? half_with_counts(top, bottom) : FrameFaults::Double::kNo;
}

// The picture that rows at a border are compared with: the frame without as many rows as telemetry
// can have.
struct Picture {
  UsualRows usual;
  std::vector<std::uint32_t> pixels;  // with each count
  double all = 0;
  int low = 0, high = 0;  // counts between which nearly all pixels lie

  [[nodiscard]] bool lacks(int count) const {
    return pixels[static_cast<std::size_t>(count)] < 0.01 * all;
  }
};

Picture picture_within(Counts frame, const InputFaultTuning& tuning) {
  const int margin = tuning.most_telemetry_rows;
  const Counts inner = frame.crop(0, margin, frame.width(), frame.height() - 2 * margin);
  Picture picture{usual_rows(inner), std::vector<std::uint32_t>(65536)};
  for (int y = 0; y < inner.height(); ++y) {
    for (int x = 0; x < inner.width(); ++x) {
      ++picture.pixels[inner(x, y)];
    }
  }
  picture.all = static_cast<double>(inner.size());
  const auto count_of = [&](double share) {
    double pixels = 0;
    int count = -1;
    while (count < 65535 && pixels <= share * picture.all) {
      pixels += picture.pixels[static_cast<std::size_t>(++count)];
    }
    return count;
  };
  picture.low = count_of(0.001);
  picture.high = count_of(0.999);
  return picture;
}

// Whether a row holds numbers that are no picture: neighbours differ wildly, one number that the
// picture lacks fills much of it, or most numbers are far from those of the picture. Rows of one
// number are borders.
bool holds_telemetry(Counts frame, int row, const Picture& picture,
                     const InputFaultTuning& tuning) {
  std::vector<int> values = row_of(frame, row);
  std::sort(values.begin(), values.end());
  const double far = tuning.stranger_distance * (picture.high - picture.low);
  const auto strangers = std::count_if(values.begin(), values.end(), [&](int value) {
    return value < picture.low - far || value > picture.high + far;
  });
  std::size_t most = 0;
  int repeated = 0;
  int distinct = 0;
  for (auto run = values.begin(); run != values.end();) {
    const auto end = std::upper_bound(run, values.end(), *run);
    if (static_cast<std::size_t>(end - run) > most) {
      most = static_cast<std::size_t>(end - run);
      repeated = *run;
    }
    ++distinct;
    run = end;
  }
  const bool is_rough =
      roughness_of(frame, row) > tuning.telemetry_roughness * picture.usual.roughness;
  const bool is_filled =
      static_cast<double>(most) > tuning.telemetry_repeats * static_cast<double>(values.size()) &&
      picture.lacks(repeated);
  const bool is_strange = static_cast<double>(strangers) >
                          tuning.telemetry_strangers * static_cast<double>(values.size());
  return distinct > 1 && (is_rough || is_filled || is_strange);
}

// Rows of telemetry at the border that `row_at(0)` lies at; row_at(1) is the next one.
template <class F>
int telemetry_rows(Counts frame, const Picture& picture, const InputFaultTuning& tuning,
                   F&& row_at) {
  for (int rows = tuning.most_telemetry_rows; rows > 0; --rows) {
    const int outer = row_at(rows - 1);
    const int inner = row_at(rows);
    if (!holds_telemetry(frame, outer, picture, tuning) ||
        holds_telemetry(frame, inner, picture, tuning)) {
      continue;
    }
    const bool is_like =
        std::abs(correlation(row_of(frame, outer), row_of(frame, inner))) > tuning.most_correlation;
    const bool is_far =
        jump_between(frame, outer, inner) > tuning.telemetry_jump * picture.usual.jump;
    if (is_far && !is_like) {
      return rows;
    }
  }
  return 0;
}

// Pixels of this count that are connected to the border through such pixels.
std::int64_t connected_to_border(Counts frame, int count) {
  Image<std::uint8_t> reached(frame.width(), frame.height());
  fill_pixels(reached.view(), std::uint8_t{0});
  std::vector<std::pair<int, int>> open;
  std::int64_t pixels = 0;
  const auto reach = [&](int x, int y) {
    const bool is_inside = x >= 0 && y >= 0 && x < frame.width() && y < frame.height();
    if (is_inside && reached(x, y) == 0 && frame(x, y) == count) {
      reached(x, y) = 1;
      open.emplace_back(x, y);
      ++pixels;
    }
  };
  for (int x = 0; x < frame.width(); ++x) {
    reach(x, 0);
    reach(x, frame.height() - 1);
  }
  for (int y = 0; y < frame.height(); ++y) {
    reach(0, y);
    reach(frame.width() - 1, y);
  }
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    reach(x - 1, y);
    reach(x + 1, y);
    reach(x, y - 1);
    reach(x, y + 1);
  }
  return pixels;
}

std::optional<int> invalid_border(Counts frame, ImageView<const std::uint8_t> valid,
                                  const InputFaultTuning& tuning) {
  std::vector<int> counts;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (valid.empty() || valid(x, y) != 0) {
        counts.push_back(frame(x, y));
      }
    }
  }
  std::sort(counts.begin(), counts.end());
  if (counts.empty() || counts.front() == counts.back()) {
    return std::nullopt;
  }
  const auto all = static_cast<double>(counts.size());
  for (const int count : {counts.front(), counts.back()}) {
    const auto [first, last] = std::equal_range(counts.begin(), counts.end(), count);
    const auto equal = static_cast<double>(last - first);
    std::vector<int> others(counts.begin(), first);
    others.insert(others.end(), last, counts.end());
    if (equal < tuning.least_invalid_share * all || others.size() < 100) {
      continue;
    }
    // A few dead pixels may lie in between.
    const std::size_t tail = others.size() / 100;
    const int low = others[tail];
    const int high = others[others.size() - 1 - tail];
    const int gap = count < low ? low - count : count - high;
    const bool is_apart = gap > 2 && gap > tuning.least_gap * (high - low) &&
                          std::count_if(others.begin(), others.end(), [&](int other) {
                            return 2 * std::abs(other - count) < gap;
                          }) <= static_cast<std::ptrdiff_t>(others.size() / 1000);
    if (is_apart && static_cast<double>(connected_to_border(frame, count)) >
                        tuning.least_border_share * equal) {
      return count;
    }
  }
  return std::nullopt;
}

bool is_constant(Counts frame) {
  const std::uint16_t first = frame(0, 0);
  for (int y = 0; y < frame.height(); ++y) {
    if (!std::all_of(frame.row(y), frame.row(y) + frame.width(),
                     [&](std::uint16_t count) { return count == first; })) {
      return false;
    }
  }
  return true;
}

std::string rows_text(int rows, const std::string& where) {
  return std::to_string(rows) + (rows == 1 ? " row at the " : " rows at the ") + where;
}

}  // namespace

FrameFaults find_input_faults(Counts frame, ImageView<const std::uint8_t> valid, int bits,
                              const InputFaultTuning& tuning) {
  FrameFaults faults;
  Image<std::uint16_t> swapped;
  if (bits == 16 && is_swapped(frame, tuning)) {
    faults.is_swapped = true;
    swapped = with_bytes_swapped(frame);
    frame = swapped;
  }
  faults.half = double_picture(frame, usual_rows(frame), tuning);
  if (faults.half != FrameFaults::Double::kNo) {
    return faults;
  }
  const Picture picture = picture_within(frame, tuning);
  faults.rows_above = telemetry_rows(frame, picture, tuning, [](int depth) { return depth; });
  faults.rows_below =
      telemetry_rows(frame, picture, tuning, [&](int depth) { return frame.height() - 1 - depth; });
  const int height = frame.height() - faults.rows_above - faults.rows_below;
  const Counts rest = frame.crop(0, faults.rows_above, frame.width(), height);
  faults.invalid_counts = invalid_border(
      rest, valid.empty() ? valid : valid.crop(0, faults.rows_above, frame.width(), height),
      tuning);
  return faults;
}

void InputFaultFinder::add(Counts frame, ImageView<const std::uint8_t> valid, int bits) {
  if (std::min(frame.width(), frame.height()) < tuning_.smallest_side_px ||
      frames_ >= tuning_.most_frames || is_constant(frame)) {
    return;
  }
  ++frames_;
  width_ = frame.width();
  height_ = frame.height();
  const FrameFaults faults = find_input_faults(frame, valid, bits, tuning_);
  if (!common_) {
    common_ = faults;
    return;
  }
  common_->is_swapped = common_->is_swapped && faults.is_swapped;
  common_->rows_above = std::min(common_->rows_above, faults.rows_above);
  common_->rows_below = std::min(common_->rows_below, faults.rows_below);
  common_->half = common_->half == faults.half ? faults.half : FrameFaults::Double::kNo;
  common_->invalid_counts =
      common_->invalid_counts == faults.invalid_counts ? faults.invalid_counts : std::nullopt;
}

std::vector<InputFault> InputFaultFinder::faults() const {
  std::vector<InputFault> list;
  const FrameFaults found = common_.value_or(FrameFaults());
  if (found.is_swapped) {
    list.push_back({"--byte-order", "source.byte_order", "swapped",
                    "the two bytes of each count are swapped"});
  }
  if (found.half != FrameFaults::Double::kNo) {
    const bool is_top = found.half == FrameFaults::Double::kUseTop;
    list.push_back({"--crop", "source.crop", is_top ? "top-half" : "bottom-half",
                    std::string("two pictures, one above the other; counts in the ") +
                        (is_top ? "upper" : "lower")});
  }
  if (found.rows_above + found.rows_below > 0) {
    const std::string above = found.rows_above > 0 ? rows_text(found.rows_above, "top") : "";
    const std::string below = found.rows_below > 0 ? rows_text(found.rows_below, "bottom") : "";
    const std::string both = above.empty() || below.empty() ? "" : " and ";
    const int height = height_ - found.rows_above - found.rows_below;
    list.push_back({"--crop", "source.crop",
                    "0," + std::to_string(found.rows_above) + "," + std::to_string(width_) + "," +
                        std::to_string(height),
                    above + both + below + " are telemetry, no picture"});
  }
  if (found.invalid_counts) {
    list.push_back({"--invalid", "", std::to_string(*found.invalid_counts),
                    "a border of this count, which is no measurement"});
  }
  return list;
}

}  // namespace thermedge::detail
