#include "thermedge/stages/preprocessor.hpp"

namespace thermedge {

ImageView<const std::uint16_t> Preprocessor::run(ImageView<const std::uint16_t> frame,
                                                 double sigma_counts, ParallelRunner& runner) {
  corrected_.resize(frame.width(), frame.height());
  copy_pixels(frame, corrected_.view());
  bad_pixels_.clear();
  stripes_.columns.clear();
  stripes_.rows.clear();
  if (options_.bad_pixels) {
    replace_bad_pixels(corrected_, sigma_counts, options_, bad_pixels_);
  }
  if (options_.stripes) {
    finder_.measure(corrected_, sigma_counts, runner, stripes_);
    remove_stripes(stripes_, corrected_);
  }
  return corrected_;
}

}  // namespace thermedge
