#include "thermedge/stages/noise_model_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "noise_block_simd.hpp"
#include "order_statistics.hpp"

namespace thermedge {
namespace {

constexpr int kSide = kNoiseBlockPx;
constexpr double kSigmaOverMad = 1.4826;        // of a Gaussian
constexpr double kRoundingVariance = 1.0 / 12;  // of rounding to whole counts

constexpr std::size_t index_of(int across, int down) {
  return static_cast<std::size_t>(down * kSide + across);
}

// Of value(u, v) over the frequencies 1 .. last; those of u, v and v, u come as one, so that a
// transposed frame has the same sums to the last bit.
template <class F>
auto sum_over_frequencies(int last, F&& value) {
  auto sum = decltype(value(1, 1))(0);
  for (int v = 1; v <= last; ++v) {
    for (int u = 1; u < v; ++u) {
      sum += value(u, v) + value(v, u);
    }
    sum += value(v, v);
  }
  return sum;
}

// Where blocks begin that cover `length` pixels, the same from both ends.
void place_blocks(int length, std::vector<int>& begins) {
  const int count = (length + kSide - 1) / kSide;
  begins.resize(static_cast<std::size_t>(count));
  const int last = length - kSide;
  for (int i = 0; i < count; ++i) {
    const int mirrored = count - 1 - i;
    const int begin = count > 1 ? std::min(i, mirrored) * last / (count - 1) : 0;
    begins[static_cast<std::size_t>(i)] = i <= mirrored ? begin : last - begin;
  }
}

struct Extremes {
  std::uint16_t least = std::numeric_limits<std::uint16_t>::max();
  std::uint16_t greatest = 0;
};

Extremes extremes_of(ImageView<const std::uint16_t> frame) {
  Extremes found;
  for (int y = 0; y < frame.height(); ++y) {
    const auto [least, greatest] = std::minmax_element(frame.row(y), frame.row(y) + frame.width());
    found.least = std::min(found.least, *least);
    found.greatest = std::max(found.greatest, *greatest);
  }
  return found;
}

bool all_valid(ImageView<const std::uint8_t> block) {
  for (int y = 0; y < block.height(); ++y) {
    if (std::any_of(block.row(y), block.row(y) + kSide, [](std::uint8_t v) { return v == 0; })) {
      return false;
    }
  }
  return true;
}

// All one value, the frame's least or greatest.
bool is_clipped(ImageView<const std::uint16_t> block, const Extremes& frame) {
  const std::uint16_t first = block(0, 0);
  if (first != frame.least && first != frame.greatest) {
    return false;
  }
  for (int y = 0; y < block.height(); ++y) {
    if (std::any_of(block.row(y), block.row(y) + kSide,
                    [first](std::uint16_t value) { return value != first; })) {
      return false;
    }
  }
  return true;
}

}  // namespace

void NoiseModelEstimator::measure(ImageView<const std::uint16_t> frame,
                                  ImageView<const std::uint8_t> valid, double pixel_sigma_counts,
                                  NoiseModel& model) {
  if (!find(frame, valid, model)) {
    model.set_white(pixel_sigma_counts);
  }
}

bool NoiseModelEstimator::find(ImageView<const std::uint16_t> frame,
                               ImageView<const std::uint8_t> valid, NoiseModel& model) {
  model.set_white(0);
  if (std::min(frame.width(), frame.height()) < kSide) {
    return false;
  }
  model.map.reserve(frame.width(), frame.height());
  transform_blocks(frame, valid);
  if (coefficients_.size() < tuning_.fewest_blocks) {
    return false;
  }
  find_spectrum(model);
  if (model.level_counts > 0) {
    find_map(frame.width(), frame.height(), model);
  }
  return true;
}

void NoiseModelEstimator::transform_blocks(ImageView<const std::uint16_t> frame,
                                           ImageView<const std::uint8_t> valid) {
  place_blocks(frame.width(), lefts_);
  place_blocks(frame.height(), tops_);
  const std::size_t blocks = lefts_.size() * tops_.size();
  coefficients_.reserve(blocks);
  energies_.reserve(blocks);
  usable_.reserve(blocks);
  sample_.reserve(blocks);
  flat_.reserve(blocks);
  chosen_.reserve(kCoefficients);
  nodes_.resize(static_cast<int>(lefts_.size()) + 1, static_cast<int>(tops_.size()) + 1);
  coefficients_.clear();
  energies_.clear();
  usable_.clear();
  const Extremes extremes = extremes_of(frame);
  for (const int top : tops_) {
    for (const int left : lefts_) {
      const auto block = frame.crop(left, top, kSide, kSide);
      if (is_clipped(block, extremes) ||
          !(valid.empty() || all_valid(valid.crop(left, top, kSide, kSide)))) {
        usable_.push_back(-1);
        continue;
      }
      usable_.push_back(static_cast<std::int32_t>(coefficients_.size()));
      detail::noise_block(block.data(), block.stride(), coefficients_.emplace_back());
      energies_.push_back(sum_over_frequencies(kSide - 1, [&](int u, int v) {
        const float value = coefficients_.back()[index_of(u, v)];
        return value * value;
      }));
    }
  }
}

// Fills flat_ with the blocks that have the least energy.
template <class Energy>
void NoiseModelEstimator::find_flat(Energy&& energy_of) {
  sample_.clear();
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    sample_.push_back(energy_of(i));
  }
  const std::size_t blocks = sample_.size();
  const auto share = static_cast<std::size_t>(tuning_.flat_share * static_cast<double>(blocks));
  const std::size_t flat = std::max(share, std::min(tuning_.fewest_flat, blocks / 2));
  const float flattest = detail::nth_value(std::span(sample_), flat - 1);
  flat_.clear();
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    if (energy_of(i) <= flattest) {
      flat_.push_back(i);
    }
  }
}

// The variance of a coefficient by its median magnitude over the flat blocks.
double NoiseModelEstimator::variance_of_flat(std::size_t coefficient) {
  sample_.clear();
  for (const std::size_t block : flat_) {
    sample_.push_back(std::abs(coefficients_[block][coefficient]));
  }
  const double deviation = kSigmaOverMad * static_cast<double>(detail::nth_value(
                                               std::span(sample_), sample_.size() / 2));
  return std::max(deviation * deviation - kRoundingVariance, 0.0);
}

// A coefficient has no say in which blocks count for it. For the low ones, where edges have most of
// their energy, all others choose; for the rest the low ones.
void NoiseModelEstimator::find_spectrum(NoiseModel& model) {
  constexpr int kLow = 3;
  std::array<double, kCoefficients> variances{};
  for (int v = 1; v <= kLow; ++v) {
    for (int u = 1; u <= kLow; ++u) {
      const std::size_t at = index_of(u, v);
      find_flat([&](std::size_t block) {
        const float own = coefficients_[block][at];
        return energies_[block] - own * own;
      });
      variances[at] = variance_of_flat(at);
    }
  }
  find_flat([&](std::size_t block) {
    return sum_over_frequencies(kLow, [&](int u, int v) {
      const float value = coefficients_[block][index_of(u, v)];
      return value * value;
    });
  });
  for (int v = 1; v < kSide; ++v) {
    for (int u = 1; u < kSide; ++u) {
      if (std::max(u, v) > kLow) {
        variances[index_of(u, v)] = variance_of_flat(index_of(u, v));
      }
    }
  }
  // Frequencies at the scale of edges, what the oriented kernels respond to: the first 6
  // diagonally.
  const double mean =
      sum_over_frequencies(
          kLow, [&](int u, int v) { return u + v <= kLow + 1 ? variances[index_of(u, v)] : 0; }) /
      6;
  model.level_counts = std::sqrt(mean);
  if (!(mean > 0)) {
    return;
  }
  const auto relative = [&](int across, int down) {
    return std::max(variances[index_of(across, down)] / mean, tuning_.least_variance);
  };
  // The first frequency less how it grows from the second one on, half as much.
  const auto extended = [&](double first, double second) {
    return first * std::clamp(std::sqrt(first / second), 1.0, tuning_.most_extension);
  };
  std::array<double, kSide> on_top{};
  std::array<double, kSide> on_left{};
  for (int i = 1; i < kSide; ++i) {
    on_top[static_cast<std::size_t>(i)] = extended(relative(i, 1), relative(i, 2));
    on_left[static_cast<std::size_t>(i)] = extended(relative(1, i), relative(2, i));
  }
  on_top[0] = on_left[0] = std::sqrt(on_top[1] * on_left[1]);
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      model.spectrum[index_of(u, v)] =
          static_cast<float>(v == 0   ? on_top[static_cast<std::size_t>(u)]
                             : u == 0 ? on_left[static_cast<std::size_t>(v)]
                                      : relative(u, v));
    }
  }
}

// The level at a node, from the blocks around it; their quantile, as a share of what noise has.
float NoiseModelEstimator::node(int column, int row, int columns, int rows) {
  const auto blocks_across = static_cast<int>(lefts_.size());
  const auto blocks_down = static_cast<int>(tops_.size());
  const auto reaches = [&](int block, int blocks, int node, int nodes) {
    return 2 * std::abs(block * (nodes - 1) - node * (blocks - 1)) <=
           tuning_.half_reach_halves * (nodes - 1);
  };
  sample_.clear();
  for (int y = 0; y < blocks_down; ++y) {
    if (!reaches(y, blocks_down, row, rows)) {
      continue;
    }
    for (int x = 0; x < blocks_across; ++x) {
      const std::int32_t usable = usable_[static_cast<std::size_t>(y * blocks_across + x)];
      if (usable >= 0 && reaches(x, blocks_across, column, columns)) {
        sample_.push_back(energies_[static_cast<std::size_t>(usable)]);
      }
    }
  }
  // Half of the blocks missing, and it is the others' word for the frame.
  const int side = tuning_.half_reach_halves;
  if (sample_.size() * 4 < static_cast<std::size_t>(side * side) / 2) {
    return 1;
  }
  const auto rank =
      static_cast<std::size_t>(tuning_.quantile * static_cast<double>(sample_.size() - 1));
  const double level = std::sqrt(detail::nth_value(std::span(sample_), rank) / quantile_of_noise_);
  const double even = tuning_.even_within;
  constexpr double kLeast = 0.01;  // as good as no noise, and no zero to divide by
  return static_cast<float>(level > even       ? level / even
                            : level < 1 / even ? std::max(level * even, kLeast)
                                               : 1);
}

// The coefficients that tell most of the noise and least of the scene: the highest frequencies at
// which there is noise, whole diagonals, so that a transposed frame has the same.
void NoiseModelEstimator::choose_coefficients(const NoiseSpectrum& spectrum) {
  chosen_.clear();
  for (int sum = 2 * (kSide - 1); sum >= 2 && chosen_.size() < tuning_.fewest_coefficients; --sum) {
    for (int u = std::max(sum - (kSide - 1), 1); u <= std::min(sum - 1, kSide - 1); ++u) {
      const std::size_t at = index_of(u, sum - u);
      if (static_cast<double>(spectrum[at]) >= tuning_.least_chosen_variance) {
        chosen_.push_back(at);
      }
    }
  }
}

// Mean energies of the chosen coefficients, in units of what the spectrum says.
void NoiseModelEstimator::find_map(int width, int height, NoiseModel& model) {
  const auto nodes_for = [&](std::size_t blocks) {
    const auto steps =
        (static_cast<int>(blocks) + tuning_.node_step_blocks - 1) / tuning_.node_step_blocks;
    return std::max(steps, 2);
  };
  choose_coefficients(model.spectrum);
  if (chosen_.size() < tuning_.fewest_coefficients) {
    return;  // the spectrum is that of a scene without noise
  }
  std::array<double, kCoefficients> weights{};
  for (const std::size_t at : chosen_) {
    weights[at] =
        1 / (model.level_counts * model.level_counts * static_cast<double>(model.spectrum[at]));
  }
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    const double sum = sum_over_frequencies(kSide - 1, [&](int u, int v) {
      const double value = coefficients_[i][index_of(u, v)];
      return value * value * weights[index_of(u, v)];
    });
    energies_[i] = static_cast<float>(sum / static_cast<double>(chosen_.size()));
  }
  // Of a chi-square over its degrees of freedom, by Wilson and Hilferty.
  const double part = 2.0 / (9.0 * static_cast<double>(chosen_.size()));
  const double root = 1 - part + tuning_.quantile_z * std::sqrt(part);
  quantile_of_noise_ = root * root * root;
  nodes_.resize(nodes_for(lefts_.size()), nodes_for(tops_.size()));
  bool even = true;
  for (int y = 0; y < nodes_.height(); ++y) {
    for (int x = 0; x < nodes_.width(); ++x) {
      nodes_(x, y) = node(x, y, nodes_.width(), nodes_.height());
      even = even && nodes_(x, y) == 1;
    }
  }
  if (!even) {
    model.map.set_nodes(nodes_, width, height);
  }
}

}  // namespace thermedge
