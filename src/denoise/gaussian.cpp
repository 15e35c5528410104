#include "gaussian.hpp"

#include <algorithm>
#include <cmath>

#include "float_frame.hpp"
#include "portable_math.hpp"
#include "smoothing_simd.hpp"

namespace thermedge::detail {
namespace {

constexpr int kRowsPerTask = 16;
constexpr int kScratchRows = 3;  // of a task

int tasks(int height) { return (height + kRowsPerTask - 1) / kRowsPerTask; }

}  // namespace

int GaussianFilter::radius() const {
  return options_.sigma_px == 0
             ? kPaperKernelRadius
             : static_cast<int>(std::ceil(tuning_.cutoff_sigmas * options_.sigma_px));
}

void GaussianFilter::make_weights(double share) {
  const auto reach = static_cast<std::size_t>(radius());
  const double sigma_px = std::max(share * options_.sigma_px, tuning_.narrowest_px);
  const double scale = -0.5 / (sigma_px * sigma_px);
  double sum = 1;
  for (std::size_t i = 1; i <= reach; ++i) {
    sum += 2 * portable_exp(scale * static_cast<double>(i * i));
  }
  weights_.resize(reach + 1);
  for (std::size_t i = 0; i <= reach; ++i) {
    weights_[i] = static_cast<float>(portable_exp(scale * static_cast<double>(i * i)) / sum);
  }
}

void GaussianFilter::filter_row(int y, float* scratch, float* more_scratch, float* result) const {
  const int reach = radius();
  const int width = padded_.width() - 2 * reach;
  const float* centre = padded_.row(y + reach);
  if (options_.sigma_px == 0) {
    return paper_kernel_row(centre + reach, padded_.stride(), width, scratch, more_scratch, result);
  }
  smooth_row(centre, padded_.stride(), weights_.data(), reach, padded_.width(), scratch);
  smooth_row(scratch + reach, 1, weights_.data(), reach, width, result);
}

void GaussianFilter::prepare(int width, int height) {
  const int reach = radius();
  weights_.reserve(static_cast<std::size_t>(reach) + 1);
  padded_.resize(width + 2 * reach, height + 2 * reach);
  rows_.resize(padded_.width(), kScratchRows * tasks(height));
}

void GaussianFilter::run(ImageView<const float> in, double share, ImageView<float> out,
                         ParallelRunner& runner) {
  prepare(in.width(), in.height());
  if (options_.sigma_px > 0) {
    make_weights(share);
  }
  const int reach = radius();
  for (int y = 0; y < padded_.height(); ++y) {
    mirrored_row(in, y - reach, reach, padded_.width(), padded_.row(y));
  }
  runner.run(tasks(in.height()), [&](int task) {
    const int end = std::min((task + 1) * kRowsPerTask, out.height());
    for (int y = task * kRowsPerTask; y < end; ++y) {
      const bool is_short = out.width() < kGaussianSlack;
      float* result = is_short ? rows_.row(kScratchRows * task + 2) : out.row(y);
      filter_row(y, rows_.row(kScratchRows * task), rows_.row(kScratchRows * task + 1), result);
      if (is_short) {
        std::copy_n(result, out.width(), out.row(y));
      }
    }
  });
}

}  // namespace thermedge::detail
