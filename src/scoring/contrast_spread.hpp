// How the contrast along curves spreads where no edge is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "edgel_contrast.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/noise_model.hpp"
#include "thermedge/stages/significance.hpp"

namespace thermedge::detail {

// Lines are laid through the frame where no sure edge is; pieces of them are measured as if they
// were edges. For curves along the columns, along the rows and oblique ones, and for pieces of 8 to
// 128 edgels, the variance of the mean contrast times the number of edgels: independent of it for
// white noise, growing where noise goes on along a curve.
class ContrastSpread {
 public:
  ContrastSpread(const ContrastSpreadTuning& tuning, const SideSlopeTuning& slopes,
                 const ContrastTuning& contrast);

  // Makes the memory for frames of this size and curves of up to so many edgels.
  void prepare(int width, int height);

  // `busy`: nonzero where sure edges are near. `noise` has a level above 0.
  void measure(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> busy,
               const NoiseModel& noise);

  // Variance of the mean contrast less its slope along a curve, in units of the square of the
  // noise's level where the map is 1. The curve's edgels have normals.
  [[nodiscard]] double variance(const Edgels& edgels, Range range, const NoiseLevelMap& map) const;

  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(line_.x, line_.y, line_.nx, line_.ny, weights_, contrasts_, sums_, samples_);
  }

 private:
  static constexpr std::size_t kLengths = 5;  // 8, 16, 32, 64, 128 edgels
  static constexpr std::size_t kShortest = 8;
  enum Course : std::size_t { kAlongColumns, kAlongRows, kOblique };
  static constexpr std::size_t kCourses = 3;
  struct Normal {  // unit vector across a line
    double x = 0;
    double y = 0;
  };

  void lay_lines(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> busy,
                 const NoiseModel& noise, Normal normal, Course course);
  void measure_line(ImageView<const std::uint16_t> frame, const NoiseModel& noise, Normal normal,
                    Course course, int end);
  // Fill contrasts_ with those along the line, less the slope, counts.
  void take_contrasts_on_axis(ImageView<const std::uint16_t> frame, Course course);
  void take_contrasts(ImageView<const std::uint16_t> frame, Normal normal);
  void find_variances(Course course);
  [[nodiscard]] int steps() const;  // of the contrast
  [[nodiscard]] double at(std::size_t course, double edgels) const;
  [[nodiscard]] double level_at(const NoiseLevelMap& map, int x, int y) const;
  [[nodiscard]] std::vector<float>& samples(std::size_t course, std::size_t length) {
    return samples_[course * kLengths + length];
  }

  ContrastSpreadTuning tuning_;
  SideSlopeTuning slopes_;
  ContrastTuning contrast_;
  std::vector<double> weights_;  // along an axis: of the differences between pixels this far away
  int width_ = 0;                // of the frame
  int height_ = 0;
  Edgels line_;
  std::vector<double> contrasts_;
  std::vector<double> sums_;  // of them along the line, in units of the noise there
  std::vector<std::vector<float>> samples_ = std::vector<std::vector<float>>(kCourses * kLengths);
  std::array<std::array<double, kLengths>, kCourses> variances_{};
};

}  // namespace thermedge::detail
