// The order of the stages, one class a kind of preset.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <stop_token>

#include "thermedge/detection.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/frame.hpp"
#include "thermedge/options.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"

namespace thermedge::detail {

// The other arguments of a pipeline besides the frame.
struct Call {
  ParallelRunner& runner;
  std::stop_token stop;
  Intermediates* intermediates;      // null: not wanted
  CorrectedFrameListener* listener;  // null: none

  void tell_corrected(ImageView<const std::uint16_t> counts, const Corrections& corrections) const {
    if (listener != nullptr) {
      listener->on_corrected(counts, corrections);
    }
  }
};

class Pipeline {
 public:
  Pipeline() = default;
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;
  virtual ~Pipeline() = default;

  // `found` holds the frame's size, stamp, index and flags, and nothing else yet.
  virtual Status detect(const Frame& frame, const Call& call, Detection& found) = 0;
  virtual Status trace(ImageView<const std::uint8_t> edge_map, const Call& call,
                       Detection& found) = 0;
  // Scratch memory of all stages, bytes.
  [[nodiscard]] virtual std::size_t memory_bytes() const = 0;
};

// The one place that knows which preset is run by which pipeline.
[[nodiscard]] std::unique_ptr<Pipeline> make_pipeline(const DetectorOptions& options);

// Intermediate pictures.
template <class T>
void copy_image(ImageView<const T> from, Image<T>& to) {
  to.resize(from.width(), from.height());
  copy_pixels(from, to.view());
}

// Rounded to grey levels.
void round_to_levels(ImageView<const float> in, Image<std::uint8_t>& levels);

// Nonzero pixels become 255.
void binarize(ImageView<const std::uint8_t> map, Image<std::uint8_t>& binary);

// No edge lies on pixels that are no measurement or this near to them: the steps that filling
// leaves at their border, and responses of kernels that reach across it.
constexpr int kInvalidReachPx = 3;

// `clear` is 0 within kInvalidReachPx (the larger of dx and dy) of pixels where `valid` is 0,
// else 1.
void keep_clear_of_invalid(ImageView<const std::uint8_t> valid, Image<std::uint8_t>& clear);

// Takes edge pixels off where `clear` is 0. `clear` empty: the map itself is returned; else the
// masked copy.
[[nodiscard]] ImageView<const std::uint8_t> mask_invalid(ImageView<const std::uint8_t> edges,
                                                         ImageView<const std::uint8_t> clear,
                                                         Image<std::uint8_t>& masked);

// Notes which ends of open edges lie where invalid pixels cut them off: within 2 px of where no
// edge can be.
void mark_cut_ends(ImageView<const std::uint8_t> valid, EdgeSet& edges);

// Sets contrast, z and log10_nfa to NaN: an edge map alone has none.
void forget_contrast(EdgeSet& edges);

// Converts all that was measured in counts into the unit of a float frame.
void convert_to_frame_units(Detection& found);

}  // namespace thermedge::detail
