#include "thermedge/stages/stripes.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "column_offsets.hpp"
#include "stripe_mask.hpp"
#include "stripe_mask_simd.hpp"
#include "thermedge/memory.hpp"
#include "transpose.hpp"

namespace thermedge {
namespace {

constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

// What brings the middle of the counts to the middle of their range, so that there is room for
// offsets on both sides. From every eighth pixel both ways, so it is no bound.
int room_for_offsets(ImageView<const std::uint16_t> frame) {
  constexpr int kStep = 8;
  constexpr int kMiddle = 32768;
  int low = frame(0, 0);
  int high = low;
  for (int y = 0; y < frame.height(); y += kStep) {
    for (int x = 0; x < frame.width(); x += kStep) {
      low = std::min<int>(low, frame(x, y));
      high = std::max<int>(high, frame(x, y));
    }
  }
  return kMiddle - (low + high + 1) / 2;
}

// frame + level; single pixels far from all others, which wrap around, are as far from them then.
void copy_with_level(ImageView<const std::uint16_t> frame, int level,
                     ImageView<std::uint16_t> copy) {
  for (int y = 0; y < frame.height(); ++y) {
    std::transform(frame.row(y), frame.row(y) + frame.width(), copy.row(y),
                   [=](std::uint16_t count) { return static_cast<std::uint16_t>(count + level); });
  }
}

}  // namespace

struct StripeFinder::Impl {
  explicit Impl(const StripeTuning& chosen)
      : tuning(chosen), columns(chosen), rows(chosen), mask(chosen.mask) {}

  void prepare(int width, int height) {
    columns.prepare(width, height);
    rows.prepare(height, width);
    mask.prepare(width, height);
    copy.resize(width, height);
    transposed.resize(height, width);
    reach.resize(width, (height + 1) / 2);
    transposed_reach.resize(height, (width + 1) / 2);
  }

  StripeTuning tuning;
  detail::ColumnOffsets columns, rows;
  detail::StripeMask mask;
  Image<std::uint16_t> copy;  // whose rows may be read past their end
  Image<std::uint16_t> transposed;
  Image<std::uint16_t> reach, transposed_reach;
};

StripeFinder::StripeFinder(const StripeTuning& tuning) : impl_(std::make_unique<Impl>(tuning)) {}
StripeFinder::StripeFinder(StripeFinder&&) noexcept = default;
StripeFinder& StripeFinder::operator=(StripeFinder&&) noexcept = default;
StripeFinder::~StripeFinder() = default;

std::size_t StripeFinder::memory_bytes() const {
  const Impl& self = *impl_;
  return detail::memory_of(self.columns, self.rows, self.mask, self.copy, self.transposed,
                           self.reach, self.transposed_reach);
}

void StripeFinder::measure(ImageView<const std::uint16_t> frame, double sigma_counts,
                           ParallelRunner& runner, StripeOffsets& offsets) {
  offsets.columns.clear();
  offsets.rows.clear();
  if (std::min(frame.width(), frame.height()) < impl_->tuning.smallest_side_px) {
    return;
  }
  impl_->prepare(frame.width(), frame.height());
  offsets.columns.reserve(index(frame.width()));
  offsets.rows.reserve(index(frame.height()));
  if (!(sigma_counts > 0)) {
    return;
  }
  copy_with_level(frame, room_for_offsets(frame), impl_->copy.view());
  detail::transpose<std::uint16_t>(impl_->copy.view(), impl_->transposed.view());
  bool in_columns = false;
  bool in_rows = false;
  const auto measure_both = [&] {
    runner.run(2, [&](int i) {
      if (i == 0) {
        in_columns = impl_->columns.measure(impl_->copy, impl_->reach, sigma_counts);
      } else {
        in_rows = impl_->rows.measure(impl_->transposed, impl_->transposed_reach, sigma_counts);
      }
    });
  };
  fill_pixels(impl_->reach.view(), detail::StripeMask::kNoEdge);
  fill_pixels(impl_->transposed_reach.view(), detail::StripeMask::kNoEdge);
  runner.run(2, [&](int i) {
    if (i == 0) {
      impl_->columns.start(impl_->copy.view(), sigma_counts);
    } else {
      impl_->rows.start(impl_->transposed.view(), sigma_counts);
    }
  });
  measure_both();
  const StripeTuning& tuning = impl_->tuning;
  for (const double gradient : tuning.edge_gradients) {
    const bool weak = std::max(impl_->columns.deviation(), impl_->rows.deviation()) <
                      tuning.strong_stripes_sigmas;
    impl_->columns.take_off(impl_->copy.view(), sigma_counts);
    impl_->rows.take_off(impl_->transposed.view(), sigma_counts);
    impl_->mask.find(impl_->copy, impl_->columns.rest_of_background(), impl_->rows.background(),
                     sigma_counts, gradient, gradient == tuning.edge_gradients.back() && weak);
    impl_->mask.reach_right(impl_->reach);
    impl_->mask.reach_down(impl_->transposed_reach);
    measure_both();
  }
  const auto in_counts = [&](double offset) { return static_cast<float>(offset * sigma_counts); };
  if (in_columns) {
    std::transform(impl_->columns.offsets().begin(), impl_->columns.offsets().end(),
                   std::back_inserter(offsets.columns), in_counts);
  }
  if (in_rows) {
    std::transform(impl_->rows.offsets().begin(), impl_->rows.offsets().end(),
                   std::back_inserter(offsets.rows), in_counts);
  }
}

Status StripeOptions::check() const { return check_ranges(*this, "stripes."); }

void remove_stripes(const StripeOffsets& offsets, ImageView<std::uint16_t> frame) {
  if (offsets.columns.empty() && offsets.rows.empty()) {
    return;
  }
  for (int y = 0; y < frame.height(); ++y) {
    const float of_row = offsets.rows.empty() ? 0 : offsets.rows[index(y)];
    if (offsets.columns.empty()) {
      detail::subtract_offset_row(of_row, frame.width(), frame.row(y));
    } else {
      detail::subtract_offsets_row(offsets.columns.data(), of_row, frame.width(), frame.row(y));
    }
  }
}

}  // namespace thermedge
