#include "thermedge/stages/oriented_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "float_frame.hpp"
#include "hysteresis.hpp"
#include "oriented_filter_simd.hpp"
#include "portable_math.hpp"
#include "smoothing_simd.hpp"
#include "suppression_simd.hpp"
#include "thermedge/memory.hpp"

namespace thermedge {
namespace {

constexpr int kDirections = 12;          // of edges; 24 with the side that is warmer
constexpr std::array kSidesPx = {4, 8};  // where an edge has to be over; the second in noise only
constexpr double kNoisy = 0.5;
constexpr int kKernelSteps = 8;  // between the clean kernels and those for noise
constexpr int kBandRows = 32;
constexpr int kMaxLineRadius = 10;
constexpr std::size_t kFineGroupPx = 8;  // smaller groups of the fine derivative are left out
constexpr double kFineLow = 0.6;         // its low threshold, of the high one

// Weights of a Gaussian and of its derivative, cut off at 3.5 standard deviations.
struct Derivative {
  explicit Derivative(double sigma_px)
      : radius(static_cast<int>(std::ceil(3.5 * sigma_px))),
        smooth(static_cast<std::size_t>(radius) + 1),
        slope(smooth.size()) {
    double sum = 0;
    std::vector<double> bell;
    for (int k = 0; k <= radius; ++k) {
      bell.push_back(detail::portable_exp(-0.5 * k * k / (sigma_px * sigma_px)));
      sum += k == 0 ? bell.back() : 2 * bell.back();
    }
    for (std::size_t k = 0; k < bell.size(); ++k) {
      smooth[k] = static_cast<float>(bell[k] / sum);
      slope[k] = static_cast<float>(static_cast<double>(k) * bell[k] / sum);
    }
  }

  // The two-dimensional kernel, derivative along x, at (x, y).
  [[nodiscard]] double at(int x, int y) const {
    if (std::abs(x) > radius || std::abs(y) > radius) {
      return 0;
    }
    const double sign = x < 0 ? -1 : 1;
    return sign * slope[static_cast<std::size_t>(std::abs(x))] *
           smooth[static_cast<std::size_t>(std::abs(y))];
  }

  int radius;
  std::vector<float> smooth;
  std::vector<float> slope;  // positive; of pixels ahead, those behind have the negative
};

// Unit vector along the edges of a direction. Those of directions that mirror each other do so to
// the last bit.
struct Tangent {
  double x;
  double y;
};
Tangent tangent_of(int direction) {
  const std::array<double, 4> cosines = {1, (std::numbers::sqrt2 * (std::numbers::sqrt3 + 1)) / 4,
                                         std::numbers::sqrt3 / 2, std::numbers::sqrt2 / 2};
  const std::array<double, 4> sines = {0, (std::numbers::sqrt2 * (std::numbers::sqrt3 - 1)) / 4,
                                       0.5, std::numbers::sqrt2 / 2};
  const int folded = direction <= 6 ? direction : kDirections - direction;  // 0 .. 90 degrees
  const auto i = static_cast<std::size_t>(folded <= 3 ? folded : 6 - folded);
  const double x = folded <= 3 ? cosines[i] : sines[i];
  const double y = folded <= 3 ? sines[i] : cosines[i];
  return {direction <= 6 ? x : -x, y};
}

// A pixel of the line through the origin; halves go towards it, whatever the side.
int nearest_pixel(double value) { return static_cast<int>(std::lround(value * (1 - 1e-9))); }

// Where a pixel is compared with its neighbours across the edge: between two of them on either
// side, `share` of the way from the first to the second.
struct Across {
  int first_x, first_y;
  int second_x, second_y;
  float share;
  std::array<int, kSidesPx.size()> side_x, side_y;
};
Across across(int direction) {
  direction %= kDirections;
  const Tangent tangent = tangent_of(direction);
  const double x = -tangent.y;  // the normal
  const double y = tangent.x;
  const int step_x = x < 0 ? -1 : 1;
  const int step_y = y < 0 ? -1 : 1;
  Across out{0, 0, step_x, step_y, 0, {}, {}};
  if (std::abs(x) >= std::abs(y)) {
    out.first_x = step_x;
    out.share = static_cast<float>(std::abs(y) / std::abs(x));
  } else {
    out.first_y = step_y;
    out.share = static_cast<float>(std::abs(x) / std::abs(y));
  }
  for (std::size_t i = 0; i < kSidesPx.size(); ++i) {
    out.side_x[i] = nearest_pixel(kSidesPx[i] * x);
    out.side_y[i] = nearest_pixel(kSidesPx[i] * y);
  }
  return out;
}

// What adds derivatives up along the edges of one direction.
struct Line {
  std::array<int, kMaxLineRadius + 1> dx;
  std::array<int, kMaxLineRadius + 1> dy;
  float gx_gain;  // the response is the line's sum of gx_gain gx + gy_gain gy: noise of 1 makes 1
  float gy_gain;
};

struct LineWeights {
  int radius;
  std::array<float, kMaxLineRadius + 1> weights;
};

LineWeights line_weights(double across_px, double along_px) {
  const double variance = along_px * along_px - across_px * across_px;
  LineWeights line{
      std::min(static_cast<int>(std::ceil(2.25 * std::sqrt(variance))), kMaxLineRadius), {}};
  for (int k = 0; k <= line.radius; ++k) {
    line.weights[static_cast<std::size_t>(k)] =
        k == 0 ? 1.0F : static_cast<float>(detail::portable_exp(-0.5 * k * k / variance));
  }
  return line;
}

Line make_line(int direction, const LineWeights& weights, const Derivative& derivative) {
  const Tangent tangent = tangent_of(direction);
  Line line{};
  for (int k = 0; k <= weights.radius; ++k) {
    line.dx[static_cast<std::size_t>(k)] = nearest_pixel(k * tangent.x);
    line.dy[static_cast<std::size_t>(k)] = nearest_pixel(k * tangent.y);
  }
  // What white noise makes of it: the root of the sum of the squares of the whole kernel.
  const int reach = derivative.radius + weights.radius;
  double power = 0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      double value = 0;
      for (int k = -weights.radius; k <= weights.radius; ++k) {
        const auto i = static_cast<std::size_t>(std::abs(k));
        const int sign = k < 0 ? -1 : 1;
        const int at_x = x - sign * line.dx[i];
        const int at_y = y - sign * line.dy[i];
        value += static_cast<double>(weights.weights[i]) *
                 (-tangent.y * derivative.at(at_x, at_y) + tangent.x * derivative.at(at_y, at_x));
      }
      power += value * value;
    }
  }
  const double gain = 1 / std::sqrt(power);
  line.gx_gain = static_cast<float>(-tangent.y * gain);
  line.gy_gain = static_cast<float>(tangent.x * gain);
  return line;
}

// Derivatives of a Gaussian that is longer than it is wide, at all orientations.
struct Kernels {
  Kernels(double across_px, double along_px)
      : derivative(std::clamp(across_px, 0.5, 2.0)),
        weights(line_weights(across_px, along_px)),
        size{across_px, along_px} {
    for (int i = 0; i < kDirections; ++i) {
      lines[static_cast<std::size_t>(i)] = make_line(i, weights, derivative);
    }
  }

  Derivative derivative;
  LineWeights weights;
  std::array<Line, kDirections> lines{};
  KernelSize size;
};

std::vector<Kernels> make_kernels(const OrientedFilterOptions& options) {
  std::vector<Kernels> kernels;
  for (int i = 0; i <= kKernelSteps; ++i) {
    const double share = 1.0 * i / kKernelSteps;
    const auto between = [&](double clean, double noisy) {
      return clean + share * (noisy - clean);
    };
    kernels.emplace_back(between(options.clean_across_px, options.across_px),
                         between(options.clean_along_px, options.along_px));
  }
  return kernels;
}

// What noise of 1 makes of a derivative.
double noise_gain(const Derivative& derivative) {
  double power = 0;
  for (int y = -derivative.radius; y <= derivative.radius; ++y) {
    for (int x = -derivative.radius; x <= derivative.radius; ++x) {
      power += derivative.at(x, y) * derivative.at(x, y);
    }
  }
  return std::sqrt(power);
}

Status check_input(ImageView<const float> in, double sigma_counts, double noisiness) {
  if (in.empty()) {
    return failure(ErrorCode::kInvalidArgument, "frame: it has no pixels");
  }
  if (!(sigma_counts > 0) || !std::isfinite(sigma_counts)) {
    return failure(ErrorCode::kInvalidArgument, "noise: it must be above 0 and finite");
  }
  if (!(noisiness >= 0 && noisiness <= 1)) {
    return failure(ErrorCode::kInvalidArgument, "noisiness: it must be 0 to 1");
  }
  return detail::check_finite(in);
}

}  // namespace

Status OrientedFilterOptions::check() const {
  if (along_px < across_px) {
    return failure(ErrorCode::kInvalidArgument,
                   "oriented_filter.along_px must be at least across_px");
  }
  if (clean_along_px < clean_across_px) {
    return failure(ErrorCode::kInvalidArgument,
                   "oriented_filter.clean_along_px must be at least clean_across_px");
  }
  if (high < low) {
    return failure(ErrorCode::kInvalidArgument, "oriented_filter.high must be at least low");
  }
  return check_ranges(*this, "oriented_filter.");
}

// Pictures with a margin: pixel (x, y) of the frame is at (x + margin, y + margin).
struct OrientedFilterBank::Impl {
  explicit Impl(const OrientedFilterOptions& chosen)
      : options(chosen),
        fine(std::clamp(chosen.fine_px, 0.5, 2.0)),
        fine_noise_gain(noise_gain(fine)),
        all_kernels(make_kernels(chosen)),
        kernels(&all_kernels.back()) {
    for (const Kernels& each : all_kernels) {
      largest_radius = std::max(largest_radius, each.derivative.radius);
      line_margin = std::max(line_margin, each.weights.radius);
    }
    for (int i = 0; i < 2 * kDirections; ++i) {
      steps[static_cast<std::size_t>(i)] = across(i);
    }
  }

  void prepare(int width, int height);
  template <class F>
  void for_each_band(ParallelRunner& runner, F&& task) const;
  void differentiate(const Derivative& kernel, int margin, int y_begin, int y_end, float* scratch);
  void find_fine(ParallelRunner& runner, double sigma_counts);
  void project(int band, int y_begin, int y_end, double sigma_counts);
  void find_side_offsets();
  void suppress(int band, int y_begin, int y_end);
  void merge_fine();
  [[nodiscard]] float suppressed_response_at(int x, int y) const;
  void classify(int x, int y, float over);
  void classify_row(int y, std::span<std::int32_t> xs, float* over);

  OrientedFilterOptions options;
  Derivative fine;
  double fine_noise_gain;
  std::vector<Kernels> all_kernels;  // from clean to noisy
  int largest_radius = 0;            // of their derivatives
  int line_margin = 0;               // of their lines
  const Kernels* kernels;            // of this frame
  std::size_t sides = 1;             // of kSidesPx, for this frame
  std::array<Across, 2 * kDirections> steps{};

  int width = 0, height = 0, bands = 0;
  Image<float> padded;   // margin: padding()
  Image<float> gx, gy;   // margin: that of the line, or 0 for the fine one
  Image<float> scratch;  // rows for each band
  Image<float> fine_magnitude;
  Image<float> projected;  // for each band its rows and those of the lines' margins
  Image<float> response;
  Image<std::int32_t> direction;
  Image<float> suppressed_response;
  // Of one row, for each band: pixels on ridges, and their suppressed_responses.
  Image<std::int32_t> places;
  Image<float> of_places;
  std::array<std::int32_t, 2 * kDirections * kSidesPx.size()> side_offsets{};
  Image<std::uint8_t> fine_classes, edges;
  std::vector<std::ptrdiff_t> group;

  [[nodiscard]] int padding() const { return std::max(largest_radius + line_margin, fine.radius); }
};

void OrientedFilterBank::Impl::prepare(int frame_width, int frame_height) {
  width = frame_width;
  height = frame_height;
  bands = (height + kBandRows - 1) / kBandRows;
  const int slack = detail::kFilterSlack;
  const int line = line_margin;
  padded.resize(width + 2 * padding() + slack, height + 2 * padding());
  gx.resize(width + 2 * line + slack, height + 2 * line);
  gy.resize(gx.width(), gx.height());
  scratch.resize(width + 2 * padding() + slack, 2 * bands);
  projected.resize(gx.width(), bands * (kBandRows + 2 * line));
  response.resize(width + slack, height);
  direction.resize(width + slack, height);
  suppressed_response.resize(width, height);
  places.resize(width + slack, bands);
  of_places.resize(width + slack, bands);
  find_side_offsets();
  fine_magnitude.resize(width + slack, height);
  fine_classes.resize(width + 64, height);
  edges.resize(width, height);
  group.reserve(edges.size());
}

// task(band, y_begin, y_end): the bands depend on the height alone, not on the ParallelRunner.
template <class F>
void OrientedFilterBank::Impl::for_each_band(ParallelRunner& runner, F&& task) const {
  runner.run(bands, [&](int band) {
    task(band, band * kBandRows, std::min((band + 1) * kBandRows, height));
  });
}

// Fills gx and gy, whose margin is `margin`, for the rows of the frame from y_begin to y_end.
void OrientedFilterBank::Impl::differentiate(const Derivative& kernel, int margin, int y_begin,
                                             int y_end, float* rows) {
  const int wide = width + 2 * (margin + kernel.radius);
  float* const smoothed = rows;
  float* const sloped = rows + scratch.stride();
  for (int y = y_begin; y < y_end; ++y) {
    const float* centre = padded.row(y + padding()) + padding() - margin - kernel.radius;
    detail::smooth_row(centre, padded.stride(), kernel.smooth.data(), kernel.radius, wide,
                       smoothed);
    detail::odd_filter_row(centre, padded.stride(), kernel.slope.data(), kernel.radius, wide,
                           sloped);
    const int narrow = width + 2 * margin;
    detail::odd_filter_row(smoothed + kernel.radius, 1, kernel.slope.data(), kernel.radius, narrow,
                           gx.row(y + margin));
    detail::smooth_row(sloped + kernel.radius, 1, kernel.smooth.data(), kernel.radius, narrow,
                       gy.row(y + margin));
  }
}

// Leaves in fine_classes where the fine derivative decides.
void OrientedFilterBank::Impl::find_fine(ParallelRunner& runner, double sigma_counts) {
  for_each_band(runner, [&](int band, int y_begin, int y_end) {
    differentiate(fine, 0, y_begin, y_end, scratch.row(2 * band));
    for (int y = y_begin; y < y_end; ++y) {
      detail::magnitude_row(gx.row(y), gy.row(y), width, fine_magnitude.row(y));
    }
  });
  const double high = options.fine_above * fine_noise_gain * sigma_counts;
  for_each_band(runner, [&](int, int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y) {
      std::uint8_t* classes = fine_classes.row(y);
      std::fill_n(classes, fine_classes.width(), detail::kNoEdge);
      if (y == 0 || y == height - 1 || width < 3) {
        continue;
      }
      const detail::GradientRow row{gx.row(y) + 1, gy.row(y) + 1, fine_magnitude.row(y) + 1,
                                    fine_magnitude.stride()};
      detail::suppress_row(row, width - 2, static_cast<float>(kFineLow * high),
                           static_cast<float>(high), classes + 1);
      std::fill(classes + width - 1, classes + fine_classes.width(), detail::kNoEdge);
    }
  });
  detail::apply_hysteresis(fine_classes.view().crop(0, 0, width, height), kFineGroupPx, group);
}

void OrientedFilterBank::Impl::project(int band, int y_begin, int y_end, double sigma_counts) {
  const int margin = line_margin;
  const int first_row = band * (kBandRows + 2 * margin);  // of this band in `projected`
  const auto per_sigma = static_cast<float>(1 / sigma_counts);
  for (int i = 0; i < kDirections; ++i) {
    const Line& line = kernels->lines[static_cast<std::size_t>(i)];
    const int reach = *std::max_element(line.dy.begin(), line.dy.begin() + margin + 1);
    for (int y = y_begin - reach; y < y_end + reach; ++y) {
      detail::project_row(gx.row(y + margin), gy.row(y + margin), line.gx_gain * per_sigma,
                          line.gy_gain * per_sigma, width + 2 * margin,
                          projected.row(first_row + y - y_begin + margin));
    }
    std::array<std::ptrdiff_t, kMaxLineRadius + 1> offsets{};
    for (std::size_t k = 0; k <= static_cast<std::size_t>(margin); ++k) {
      offsets[k] = line.dy[k] * projected.stride() + line.dx[k];
    }
    for (int y = y_begin; y < y_end; ++y) {
      detail::keep_stronger_row(projected.row(first_row + y - y_begin + margin) + margin,
                                offsets.data(), kernels->weights.weights.data(),
                                kernels->weights.radius, i, kDirections, width, response.row(y),
                                direction.row(y));
    }
  }
}

// By how much the response of a pixel is over that of both sides; a slope is as strong all over.
float OrientedFilterBank::Impl::suppressed_response_at(int x, int y) const {
  const std::int32_t own = direction(x, y);
  const auto at = [&](int side_x, int side_y) {
    const int turn = std::abs(direction(side_x, side_y) - own);
    return turn <= 3 || turn >= 2 * kDirections - 3 ? response(side_x, side_y) : 0.0F;
  };
  const Across& step = steps[static_cast<std::size_t>(own)];
  const int reach = kSidesPx[sides - 1];
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

// Sets the suppressed_response and the class, before hysteresis, of a pixel on a ridge.
void OrientedFilterBank::Impl::classify(int x, int y, float over) {
  suppressed_response(x, y) = over;
  edges(x, y) = over > static_cast<float>(options.high)  ? detail::kStrongEdge
                : over > static_cast<float>(options.low) ? detail::kWeakEdge
                                                         : detail::kNoEdge;
}

// Classifies the pixels of row y at these places, in ascending order. Away from the border, where
// nothing is mirrored, all together.
void OrientedFilterBank::Impl::classify_row(int y, std::span<std::int32_t> xs, float* over) {
  const int reach = kSidesPx[sides - 1];
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
  for (std::size_t side = 0; side < kSidesPx.size(); ++side) {
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
  constexpr std::array kHalfWidths = {0, 1, 2, 1, 0};  // of the rows of a disc of 2 px
  constexpr int kReach = 2;
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

OrientedFilterBank::OrientedFilterBank(const OrientedFilterOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}
OrientedFilterBank::OrientedFilterBank(OrientedFilterBank&&) noexcept = default;
OrientedFilterBank& OrientedFilterBank::operator=(OrientedFilterBank&&) noexcept = default;
OrientedFilterBank::~OrientedFilterBank() = default;

std::size_t OrientedFilterBank::memory_bytes() const {
  const Impl& self = *impl_;
  return detail::memory_of(self.padded, self.gx, self.gy, self.scratch, self.fine_magnitude,
                           self.projected, self.response, self.direction, self.suppressed_response,
                           self.places, self.of_places, self.fine_classes, self.edges, self.group);
}

Result<OrientedFilterResult> OrientedFilterBank::run(ImageView<const float> in, double sigma_counts,
                                                     double noisiness, ParallelRunner& runner) {
  Impl& self = *impl_;
  if (Status status =
          self.options.check().and_then([&] { return check_input(in, sigma_counts, noisiness); });
      !status) {
    return tl::unexpected(status.error());
  }
  self.kernels = &self.all_kernels[static_cast<std::size_t>(std::lround(noisiness * kKernelSteps))];
  self.sides = noisiness >= kNoisy ? kSidesPx.size() : 1;
  self.prepare(in.width(), in.height());
  const int padding = self.padding();
  for (int y = 0; y < self.padded.height(); ++y) {
    detail::mirrored_row(in, y - padding, padding, self.padded.width(), self.padded.row(y));
  }
  if (self.options.fine_px > 0) {
    self.find_fine(runner, sigma_counts);
  }
  const int margin = self.line_margin;
  self.for_each_band(runner, [&](int band, int y_begin, int y_end) {
    self.differentiate(self.kernels->derivative, margin, y_begin == 0 ? -margin : y_begin,
                       y_end == self.height ? y_end + margin : y_end, self.scratch.row(2 * band));
  });
  self.for_each_band(runner, [&](int band, int y_begin, int y_end) {
    self.project(band, y_begin, y_end, sigma_counts);
  });
  self.for_each_band(
      runner, [&](int band, int y_begin, int y_end) { self.suppress(band, y_begin, y_end); });
  if (self.options.fine_px > 0) {
    self.merge_fine();
  }
  detail::apply_hysteresis(self.edges.view(), 1, self.group);
  return OrientedFilterResult{self.response.view().crop(0, 0, self.width, self.height),
                              self.direction.view().crop(0, 0, self.width, self.height),
                              self.suppressed_response, self.edges, self.kernels->size};
}

}  // namespace thermedge
