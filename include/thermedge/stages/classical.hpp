// The classical edge detectors that the paper compares with (figures 14 and 15).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/canny.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge {

enum class ClassicalMethod { kPrewitt, kRoberts, kSobel, kLog, kCanny };

struct ClassicalName {
  ClassicalMethod method;
  std::string_view name;     // of files and options
  std::string_view display;  // for people
};
inline constexpr std::array kClassicalMethods = {
    ClassicalName{ClassicalMethod::kPrewitt, "prewitt", "Prewitt"},
    ClassicalName{ClassicalMethod::kRoberts, "roberts", "Roberts"},
    ClassicalName{ClassicalMethod::kSobel, "sobel", "Sobel"},
    ClassicalName{ClassicalMethod::kLog, "log", "LoG"},
    ClassicalName{ClassicalMethod::kCanny, "canny", "Canny"}};

struct ClassicalOptions {
  // Gradient magnitude (levels per px) or |LoG| (levels per px^2) above which a pixel may be an
  // edge, >= 0; 0: automatic, from the mean over the frame.
  double threshold = 0;
  bool thinning = true;     // Prewitt, Roberts, Sobel: keep maxima along the row or the column only
  double log_sigma_px = 2;  // 0.5..10 px
  int log_kernel_px = 0;    // side of the kernel, odd, 3..61; 0: 2 ceil(3 sigma) + 1; paper: 9
  // LoG as GNU Octave 7 computes it: the truncated kernel keeps its mean, so that it answers to
  // brightness, and the frame is surrounded by zeros. Else the kernel is made free of a mean and
  // the border replicated, as MATLAB does; that finds more.
  bool log_as_octave = false;
  double canny_sigma_px = 1.4142;  // Gaussian in front of Canny, 0.3..20 px; 0: none
  CannyOptions canny = {};         // `threshold` above is not for Canny
};

// Fails on the first option out of range.
[[nodiscard]] Status check_options(const ClassicalOptions& options);

// `edge` of MATLAB and of GNU Octave, on grey levels.
// Prewitt, Roberts, Sobel: borders replicated; automatic threshold sqrt(k * mean squared magnitude)
// with k = 4 (Roberts: 6, as both programs have it); thinned: a pixel stays where it is above both
// neighbours in its row or both in its column, pixels under the threshold counting as 0.
// LoG: a pixel that has a neighbour < 0 beside, above or below it is an edge where its LoG is above
// 0.75 times the mean of |LoG|. Canny: a Gaussian of sigma sqrt(2), then class Canny, whose rule
// for the thresholds is MATLAB's. One object per thread; allocates on the first frame of a size
// only. The result is bit-identical for every ParallelRunner and SIMD target. Cost at 382x288 on
// one thread: 0.2 to 0.3 ms, LoG 2.5 ms.
class ClassicalDetector {
 public:
  explicit ClassicalDetector(const ClassicalOptions& options = {});

  // `levels` -> `edges` (255 edge, 0 none), same size. Errors: empty frame, sizes differ, an option
  // out of range, a pixel that is NaN, infinite or beyond 1e9.
  [[nodiscard]] Status run(ImageView<const float> levels, ClassicalMethod method,
                           ImageView<std::uint8_t> edges, ParallelRunner& runner);

 private:
  void add_border(ImageView<const float> levels, int margin, bool zeros);
  void detect_by_gradient(ClassicalMethod method, ImageView<std::uint8_t> edges);
  void prepare_log_kernels(int radius);
  void detect_by_log(ImageView<std::uint8_t> edges);
  void filter_separably(const std::vector<double>& along_rows,
                        const std::vector<double>& along_columns);
  Status detect_by_canny(ImageView<const float> levels, ImageView<std::uint8_t> edges,
                         ParallelRunner& runner);

  ClassicalOptions options_;
  Denoiser smoother_;
  Canny canny_;
  Image<float> smoothed_;
  Image<double> bordered_;  // the levels with a margin
  Image<double> response_;  // squared gradient with a margin of 1, or LoG
  Image<double> rows_;      // levels filtered along the rows
  std::vector<double> gauss_, second_, ones_, minus_mean_;  // factors of the kernels of LoG
};

}  // namespace thermedge
