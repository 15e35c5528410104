// BM3D written down plainly, in double precision: what the fast version is held against.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bm3d.hpp"
#include "bm3d_match_simd.hpp"
#include "thermedge/image.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge::test {

using detail::BlockPosition;

inline constexpr int kSide = detail::kBlockPx;
using Matrix = std::array<std::array<double, kSide>, kSide>;
using BlockValues = std::array<double, kSide * kSide>;

inline Matrix identity() {
  Matrix m{};
  for (std::size_t i = 0; i < kSide; ++i) {
    m[i][i] = 1;
  }
  return m;
}

// Rows are the basis functions of the orthonormal DCT-II.
inline Matrix dct_matrix() {
  Matrix m;
  for (std::size_t k = 0; k < kSide; ++k) {
    for (std::size_t n = 0; n < kSide; ++n) {
      const double scale = k == 0 ? std::sqrt(0.125) : 0.5;
      m[k][n] = scale * std::cos(std::numbers::pi * static_cast<double>((2 * n + 1) * k) / 16);
    }
  }
  return m;
}

// One level of the periodic filter bank on the first `count` samples: averages, then differences.
inline void bior15_level(std::array<double, kSide>& x, int count) {
  constexpr std::array<double, 10> kLowPass = {3, -3, -22, 22, 128, 128, 22, -22, -3, 3};
  const std::array<double, kSide> in = x;
  for (int i = 0; i < count / 2; ++i) {
    double average = 0;
    for (int k = 0; k < 10; ++k) {
      const int position = (2 * i + k - 4 + 2 * count) % count;
      average += kLowPass[static_cast<std::size_t>(k)] * in[static_cast<std::size_t>(position)];
    }
    const auto even = static_cast<std::size_t>(2 * i);
    x[static_cast<std::size_t>(i)] = average * std::numbers::sqrt2 / 256;
    x[static_cast<std::size_t>(count / 2 + i)] = (in[even] - in[even + 1]) / std::numbers::sqrt2;
  }
}

inline Matrix bior15_matrix() {
  Matrix m;
  for (std::size_t n = 0; n < kSide; ++n) {
    std::array<double, kSide> x{};
    x[n] = 1;
    for (const int count : {8, 4, 2}) {
      bior15_level(x, count);
    }
    for (std::size_t k = 0; k < kSide; ++k) {
      m[k][n] = x[k];
    }
  }
  return m;
}

// Gauss-Jordan elimination with row pivots.
inline Matrix inverse(Matrix a) {
  Matrix b = identity();
  for (std::size_t c = 0; c < kSide; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < kSide; ++r) {
      pivot = std::abs(a[r][c]) > std::abs(a[pivot][c]) ? r : pivot;
    }
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = 0; r < kSide; ++r) {
      const double factor = r == c ? 1 - 1 / a[c][c] : a[r][c] / a[c][c];
      for (std::size_t i = 0; i < kSide; ++i) {
        const double a_pivot = a[c][i];
        const double b_pivot = b[c][i];
        a[r][i] -= factor * a_pivot;
        b[r][i] -= factor * b_pivot;
      }
    }
  }
  return b;
}

// m block m', transposed like the library's coefficients.
inline BlockValues transformed(const Matrix& m, const BlockValues& block) {
  BlockValues out{};
  for (std::size_t u = 0; u < kSide; ++u) {
    for (std::size_t v = 0; v < kSide; ++v) {
      for (std::size_t y = 0; y < kSide; ++y) {
        for (std::size_t x = 0; x < kSide; ++x) {
          out[u * kSide + v] += m[v][y] * m[u][x] * block[y * kSide + x];
        }
      }
    }
  }
  return out;
}

inline int block_distance(ImageView<const std::int16_t> levels, BlockPosition a, BlockPosition b) {
  int sum = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto wrapped =
          static_cast<std::int16_t>(levels(a.x + x, a.y + y) - levels(b.x + x, b.y + y));
      sum += std::abs(int{wrapped});
    }
  }
  return std::min(sum + 1, 32765);
}

// Displacements near by are sorted into squares of 2 x 2, the others, every other one of them, into
// squares of 4 x 4, outwards from those in the middle, which are 3 (or, with blocks displaced by a
// pixel, 1) and 5 wide; a class is known by its size and the indices of its square.
using NeighbourClass = std::array<int, 3>;
inline std::optional<NeighbourClass> class_of(int dx, int dy, int radius, bool with_adjacent) {
  const bool dense = std::abs(dx) <= 6 && std::abs(dy) <= 6;
  if (std::hypot(dx, dy) > radius || (!dense && (dx + dy) % 2 != 0)) {
    return {};
  }
  const int side = dense ? 2 : 4;
  const auto square = [&](int displacement) {
    const int far = std::abs(displacement) + (dense && !with_adjacent ? 0 : 1);
    return (displacement < 0 ? -1 : 1) * (far / side);
  };
  return NeighbourClass{side, square(dy), square(dx)};
}

// The group of `reference`, nearest first. Displacements are seen from the middle of the frame: of
// equals in a class the outer one, down before across, is taken, and of equals in the group the one
// that is displaced farther, then the outer one along the longer way from the middle.
inline std::vector<BlockPosition> matches(ImageView<const std::int16_t> levels,
                                          BlockPosition reference, int radius, int largest,
                                          bool with_adjacent = false) {
  struct Match {
    int distance = 0;
    std::array<int, 2> in_class;
    std::array<int, 3> in_group;
    BlockPosition block;
  };
  const int from_middle_x = 2 * reference.x - (levels.width() - kSide);
  const int from_middle_y = 2 * reference.y - (levels.height() - kSide);
  std::map<NeighbourClass, Match> best;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const auto neighbours = class_of(dx, dy, radius, with_adjacent);
      const BlockPosition block = {reference.x + dx, reference.y + dy};
      if (!neighbours || block.x < 0 || block.y < 0 || block.x > levels.width() - kSide ||
          block.y > levels.height() - kSide) {
        continue;
      }
      const auto inwards = [](int from_middle, int displacement, bool right) {
        return from_middle > 0 || (from_middle == 0 && right) ? -displacement : displacement;
      };
      const int across = inwards(from_middle_x, dx, true);
      const int down = inwards(from_middle_y, dy, true);
      const bool is_tall = std::abs(from_middle_x) < std::abs(from_middle_y);
      const Match match = {block == reference ? 0 : block_distance(levels, reference, block),
                           {inwards(from_middle_y, dy, false), inwards(from_middle_x, dx, false)},
                           {-(dx * dx + dy * dy), is_tall ? down : across, is_tall ? across : down},
                           block};
      const auto [at, added] = best.try_emplace(*neighbours, match);
      const auto is_better = [](const Match& a, const Match& b) {
        return std::tie(a.distance, a.in_class) < std::tie(b.distance, b.in_class);
      };
      if (!added && is_better(match, at->second)) {
        at->second = match;
      }
    }
  }
  std::vector<Match> found;
  for (const auto& [neighbours, match] : best) {
    found.push_back(match);
  }
  std::sort(found.begin(), found.end(), [](const Match& a, const Match& b) {
    return std::tie(a.distance, a.in_group) < std::tie(b.distance, b.in_group);
  });
  found.resize(std::bit_floor(std::min(found.size(), static_cast<std::size_t>(largest))));
  std::vector<BlockPosition> group;
  for (const Match& match : found) {
    group.push_back(match.block);
  }
  return group;
}

using Group = std::vector<BlockPosition>;

// BM3D written down plainly: one group after the other, all in double precision. The frame must be
// one that reference blocks cover: 8 px and steps, at least whole cells of 4, or whole blocks where
// a stage is thinned.
class ReferenceBm3d {
 public:
  ReferenceBm3d(const Image<double>& noisy, const detail::Bm3dSettings& settings)
      : noisy_(noisy),
        settings_(settings),
        options_(settings.options),
        width_(noisy.width()),
        height_(noisy.height()) {}

  Image<double> run() {
    Image<double> estimate = run_stage(noisy_, false);
    return options_.wiener ? run_stage(estimate, true) : std::move(estimate);
  }

 private:
  using Spectra = std::vector<BlockValues>;

  Image<double> run_stage(const Image<double>& guide, bool wiener) {
    Image<std::int16_t> levels(width_, height_);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        levels(x, y) = static_cast<std::int16_t>(std::llrint(guide(x, y) * 8));
      }
    }
    sums_.resize(width_, height_);
    weights_.resize(width_, height_);
    fill_pixels(sums_.view(), 0.0);
    fill_pixels(weights_.view(), 0.0);
    const detail::StageSettings& stage = wiener ? settings_.wiener : settings_.hard;
    const int step = settings_.step_px;
    for (int y = 0; y <= height_ - kSide; y += step) {
      for (int x = 0; x <= width_ - kSide; x += step) {
        const bool is_odd_row = y / step % 2 != 0;
        if ((stage.thinning == detail::Thinning::kChessboard && (x + y) / step % 2 != 0) ||
            (stage.thinning == detail::Thinning::kQuarter && (is_odd_row || x / step % 2 != 0))) {
          continue;
        }
        const Group group = matches(levels, {x, y}, settings_.search_radius_px, stage.largest_group,
                                    settings_.options.adjacent_blocks);
        wiener ? filter_wiener(guide, group) : filter_hard(group);
      }
    }
    Image<double> out(width_, height_);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        out(x, y) = sums_(x, y) / weights_(x, y);
      }
    }
    return out;
  }

  static Spectra spectra_of(const Image<double>& image, const Group& group, const Matrix& m) {
    Spectra spectra;
    for (const BlockPosition at : group) {
      BlockValues block;
      for (int i = 0; i < kSide * kSide; ++i) {
        block[static_cast<std::size_t>(i)] = image(at.x + i % kSide, at.y + i / kSide);
      }
      spectra.push_back(transformed(m, block));
    }
    return hadamard(spectra);
  }

  // Orthonormal Walsh-Hadamard transform along the group; its own inverse.
  static Spectra hadamard(const Spectra& in) {
    Spectra out(in.size());
    for (std::size_t k = 0; k < in.size(); ++k) {
      for (std::size_t n = 0; n < in.size(); ++n) {
        const double sign = std::popcount(k & n) % 2 == 0 ? 1 : -1;
        for (std::size_t i = 0; i < in[n].size(); ++i) {
          out[k][i] += sign * in[n][i] / std::sqrt(static_cast<double>(in.size()));
        }
      }
    }
    return out;
  }

  void filter_hard(const Group& group) {
    Spectra spectra = spectra_of(noisy_, group, bior15_);
    double kept = 0;
    for (std::size_t k = 0; k < spectra.size(); ++k) {
      for (std::size_t i = 0; i < spectra[k].size(); ++i) {
        const bool mean = k == 0 && i == 0;
        if (mean || std::abs(spectra[k][i]) > options_.lambda) {
          ++kept;
        } else {
          spectra[k][i] = 0;
        }
      }
    }
    aggregate(hadamard(spectra), group, inverse(bior15_), 1 / kept);
  }

  void filter_wiener(const Image<double>& guide, const Group& group) {
    Spectra spectra = spectra_of(noisy_, group, dct_);
    const Spectra basic = spectra_of(guide, group, dct_);
    double energy = 0;
    for (std::size_t k = 0; k < spectra.size(); ++k) {
      for (std::size_t i = 0; i < spectra[k].size(); ++i) {
        const double signal = basic[k][i] * basic[k][i];
        const double factor = k == 0 && i == 0 ? 1 : signal / (signal + 1);
        spectra[k][i] *= factor;
        energy += factor * factor;
      }
    }
    aggregate(hadamard(spectra), group, inverse(dct_), 1 / energy);
  }

  void aggregate(const Spectra& spectra, const Group& group, const Matrix& back, double weight) {
    for (std::size_t k = 0; k < group.size(); ++k) {
      const BlockValues block = transformed(back, spectra[k]);
      for (int i = 0; i < kSide * kSide; ++i) {
        const int x = group[k].x + i % kSide;
        const int y = group[k].y + i / kSide;
        const double w = weight * kaiser(i % kSide) * kaiser(i / kSide);
        sums_(x, y) += w * block[static_cast<std::size_t>(i)];
        weights_(x, y) += w;
      }
    }
  }

  [[nodiscard]] double kaiser(int i) const {
    const double position = 2.0 * i / (kSide - 1) - 1;
    return std::cyl_bessel_i(0.0, options_.kaiser_beta * std::sqrt(1 - position * position)) /
           std::cyl_bessel_i(0.0, options_.kaiser_beta);
  }

  const Image<double>& noisy_;
  detail::Bm3dSettings settings_;
  Bm3dOptions options_;
  int width_;
  int height_;
  Matrix bior15_ = bior15_matrix();
  Matrix dct_ = dct_matrix();
  Image<double> sums_;
  Image<double> weights_;
};

}  // namespace thermedge::test
