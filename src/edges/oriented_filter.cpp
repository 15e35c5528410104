#include "thermedge/stages/oriented_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "float_frame.hpp"
#include "hysteresis.hpp"
#include "oriented_filter_impl.hpp"
#include "oriented_filter_simd.hpp"
#include "smoothing_simd.hpp"
#include "suppression_simd.hpp"
#include "thermedge/memory.hpp"

namespace thermedge {
namespace {

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

void OrientedFilterBank::Impl::prepare(int frame_width, int frame_height) {
  width = frame_width;
  height = frame_height;
  bands = (height + kBandRows - 1) / kBandRows;
  const int slack = detail::kFilterSlack;
  const int line = line_margin;
  padded.resize(width + 2 * padding() + slack, height + 2 * padding());
  gx.resize(width + 2 * line + slack, height + 2 * line);
  gy.resize(gx.width(), gx.height());
  scratch.resize(width + 2 * std::max(padding(), tuning.ripple_reach_px) + slack, 2 * bands);
  projected.resize(gx.width(), bands * (kBandRows + 2 * line));
  response.resize(width + slack, height);
  direction.resize(width + slack, height);
  suppressed_response.resize(width, height);
  const int reach = tuning.ripple_reach_px;
  largest_in_row.resize(width + slack, height + 2 * reach);
  largest_around.resize(width + slack, height);
  for (int i = 0; i < reach; ++i) {
    std::fill_n(largest_in_row.row(i), width + slack, 0.0F);
    std::fill_n(largest_in_row.row(height + 2 * reach - 1 - i), width + slack, 0.0F);
  }
  places.resize(width + slack, bands);
  of_places.resize(width + slack, bands);
  find_side_offsets();
  fine_magnitude.resize(width + slack, height);
  fine_classes.resize(width + 64, height);
  edges.resize(width, height);
  group.reserve(edges.size());
}

// Fills gx and gy, whose margin is `margin`, for the rows of the frame from y_begin to y_end.
void OrientedFilterBank::Impl::differentiate(const detail::Derivative& kernel, int margin,
                                             int y_begin, int y_end, float* rows) {
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
      detail::suppress_row(row, width - 2, static_cast<float>(tuning.fine_low_ratio * high),
                           static_cast<float>(high), classes + 1);
      std::fill(classes + width - 1, classes + fine_classes.width(), detail::kNoEdge);
    }
  });
  detail::apply_hysteresis(fine_classes.view().crop(0, 0, width, height), tuning.fine_group_px,
                           group);
}

void OrientedFilterBank::Impl::project(int band, int y_begin, int y_end, double sigma_counts) {
  const int margin = line_margin;
  const int first_row = band * (kBandRows + 2 * margin);  // of this band in `projected`
  const auto per_sigma = static_cast<float>(1 / sigma_counts);
  for (int i = 0; i < kEdgeOrientations; ++i) {
    const detail::Line& line = kernels->lines[static_cast<std::size_t>(i)];
    const int reach = *std::max_element(line.dy.begin(), line.dy.begin() + margin + 1);
    for (int y = y_begin - reach; y < y_end + reach; ++y) {
      detail::project_row(gx.row(y + margin), gy.row(y + margin), line.gx_gain * per_sigma,
                          line.gy_gain * per_sigma, width + 2 * margin,
                          projected.row(first_row + y - y_begin + margin));
    }
    std::array<std::ptrdiff_t, OrientedFilterTuning::kMaxLineRadius + 1> offsets{};
    for (std::size_t k = 0; k <= static_cast<std::size_t>(margin); ++k) {
      offsets[k] = line.dy[k] * projected.stride() + line.dx[k];
    }
    for (int y = y_begin; y < y_end; ++y) {
      detail::keep_stronger_row(projected.row(first_row + y - y_begin + margin) + margin,
                                offsets.data(), kernels->weights.weights.data(),
                                kernels->weights.radius, i, kEdgeOrientations, width,
                                response.row(y), direction.row(y));
    }
  }
}

OrientedFilterBank::OrientedFilterBank(const OrientedFilterOptions& options,
                                       const OrientedFilterTuning& tuning)
    : impl_(std::make_unique<Impl>(options, tuning)) {}
OrientedFilterBank::OrientedFilterBank(OrientedFilterBank&&) noexcept = default;
OrientedFilterBank& OrientedFilterBank::operator=(OrientedFilterBank&&) noexcept = default;
OrientedFilterBank::~OrientedFilterBank() = default;

std::size_t OrientedFilterBank::memory_bytes() const {
  const Impl& self = *impl_;
  return detail::memory_of(self.padded, self.gx, self.gy, self.scratch, self.fine_magnitude,
                           self.projected, self.response, self.direction, self.suppressed_response,
                           self.largest_in_row, self.largest_around, self.places, self.of_places,
                           self.fine_classes, self.edges, self.group);
}

Result<OrientedFilterResult> OrientedFilterBank::run(ImageView<const float> in, double sigma_counts,
                                                     double noisiness, ParallelRunner& runner) {
  Impl& self = *impl_;
  if (Status status =
          self.options.check().and_then([&] { return check_input(in, sigma_counts, noisiness); });
      !status) {
    return tl::unexpected(status.error());
  }
  self.kernels = &self.all_kernels[static_cast<std::size_t>(
      std::lround(noisiness * self.tuning.kernel_steps))];
  self.sides = noisiness >= self.tuning.far_sides_from ? OrientedFilterTuning::kSides : 1;
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
  self.find_largest(runner);
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
