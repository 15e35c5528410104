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
#include "thermedge/parallel_runner.hpp"
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
               const NoiseModel& noise, ParallelRunner& runner);

  // Variance of the mean contrast less its slope along a curve, in units of the square of the
  // noise's level where the map is 1. The curve's edgels have normals.
  [[nodiscard]] double variance(const Edgels& edgels, Range range, const NoiseLevelMap& map) const;

  [[nodiscard]] std::size_t memory_bytes() const { return memory_of(weights_, lines_); }

 private:
  static constexpr std::size_t kLengths = 5;  // 8, 16, 32, 64, 128 edgels
  static constexpr std::size_t kShortest = 8;
  enum Course : std::size_t { kAlongColumns, kAlongRows, kOblique };
  static constexpr std::size_t kCourses = 3;
  struct Normal {  // unit vector across a line
    double x = 0;
    double y = 0;
  };
  struct Direction {
    Normal normal;
    Course course;
  };
  static const std::array<Direction, 6> kDirections;  // the oblique ones are the last

  // Of the lines of one direction, which are laid by one task.
  struct Lines {
    Edgels line;
    std::vector<double> contrasts;
    std::vector<double> sums;  // of them along the line, in units of the noise there
    std::array<std::vector<float>, kLengths> samples;

    [[nodiscard]] std::size_t memory_bytes() const;
  };
  struct Frame {
    ImageView<const std::uint16_t> counts;
    ImageView<const std::uint8_t> busy;
    const NoiseModel& noise;
  };

  void lay_lines(const Frame& frame, const Direction& direction, Lines& lines) const;
  void measure_line(const Frame& frame, const Direction& direction, int end, Lines& lines) const;
  // Fill contrasts with those along the line, less the slope, counts.
  void take_contrasts_on_axis(const Frame& frame, Course course, Lines& lines) const;
  void take_contrasts(const Frame& frame, Normal normal, Lines& lines) const;
  void find_variances(Course course);
  [[nodiscard]] int steps() const;  // of the contrast
  [[nodiscard]] int step_of_lines(Course course) const;
  [[nodiscard]] double at(std::size_t course, double edgels) const;
  [[nodiscard]] double level_at(const NoiseLevelMap& map, int x, int y) const;

  ContrastSpreadTuning tuning_;
  SideSlopeTuning slopes_;
  ContrastTuning contrast_;
  std::vector<double> weights_;  // along an axis: of the differences between pixels this far away
  int width_ = 0;                // of the frame
  int height_ = 0;
  std::vector<Lines> lines_ = std::vector<Lines>(kDirections.size());
  std::array<std::array<double, kLengths>, kCourses> variances_{};
};

}  // namespace thermedge::detail
