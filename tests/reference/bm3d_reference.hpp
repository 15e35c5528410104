// BM3D written down plainly, in double precision: what the fast version is held against.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "simd/bm3d_match.hpp"
#include "thermedge/denoise.hpp"
#include "thermedge/image.hpp"

namespace thermedge::test {

using detail::BlockPosition;
using detail::SearchWindow;

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
      const int difference = std::min(std::abs(int{wrapped}), 255);
      sum += difference * difference;
    }
  }
  return std::min(sum, 65535);
}

inline std::vector<BlockPosition> matches(ImageView<const std::int16_t> levels,
                                          BlockPosition reference, const SearchWindow& window,
                                          int count) {
  std::vector<std::pair<int, int>> order;  // distance, index
  for (int i = 0; i < window.width * window.height; ++i) {
    const BlockPosition candidate = {window.x + i % window.width, window.y + i / window.width};
    order.emplace_back(candidate == reference ? -1 : block_distance(levels, reference, candidate),
                       i);
  }
  std::sort(order.begin(), order.end());
  std::vector<BlockPosition> group;
  for (int i = 0; i < count; ++i) {
    const int index = order[static_cast<std::size_t>(i)].second;
    group.push_back({window.x + index % window.width, window.y + index / window.width});
  }
  return group;
}

using Group = std::vector<BlockPosition>;

// BM3D written down plainly: one group after the other, all in double precision.
class ReferenceBm3d {
 public:
  ReferenceBm3d(const Image<double>& noisy, const Bm3dOptions& options)
      : noisy_(noisy), options_(options), width_(noisy.width()), height_(noisy.height()) {}

  Image<double> run() {
    Image<double> estimate = run_stage(noisy_, false);
    return options_.wiener ? run_stage(estimate, true) : std::move(estimate);
  }

 private:
  using Spectra = std::vector<BlockValues>;

  static std::vector<int> reference_positions(int side, int step) {
    std::vector<int> positions;
    for (int i = 0; i < side - kSide; i += step) {
      positions.push_back(i);
    }
    positions.push_back(side - kSide);
    return positions;
  }

  Image<double> run_stage(const Image<double>& guide, bool wiener) {
    Image<std::int16_t> levels(width_, height_);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        levels(x, y) = static_cast<std::int16_t>(std::llrint(guide(x, y) * 4));
      }
    }
    sums_.resize(width_, height_);
    weights_.resize(width_, height_);
    fill_pixels(sums_.view(), 0.0);
    fill_pixels(weights_.view(), 0.0);
    for (const int y : reference_positions(height_, options_.step_px)) {
      for (const int x : reference_positions(width_, options_.step_px)) {
        const Group group =
            group_of(levels, {x, y}, wiener ? options_.group_wiener : options_.group_hard);
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

  Group group_of(const Image<std::int16_t>& levels, BlockPosition reference, int largest) const {
    const int side = 2 * options_.search_radius_px + 1;
    const auto [x, width] = span(reference.x, width_ - kSide + 1, side);
    const auto [y, height] = span(reference.y, height_ - kSide + 1, side);
    int count = 1;
    while (2 * count <= std::min(largest, width * height)) {
      count *= 2;
    }
    return matches(levels, reference, {x, y, width, height}, count);
  }

  // The window of `side` places around `at`, shifted into [0, places).
  std::pair<int, int> span(int at, int places, int side) const {
    const int size = std::min(side, places);
    return {std::clamp(at - options_.search_radius_px, 0, places - size), size};
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
  Bm3dOptions options_;
  int width_;
  int height_;
  Matrix bior15_ = bior15_matrix();
  Matrix dct_ = dct_matrix();
  Image<double> sums_;
  Image<double> weights_;
};

}  // namespace thermedge::test
