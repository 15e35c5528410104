// The oriented filter against plain two-dimensional convolution with each of its kernels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "oriented_reference.hpp"
#include "support/images.hpp"
#include "support/runners.hpp"
#include "support/strided_image.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge::test {
namespace {

constexpr double kSigma = 5;

// Blobs and noise in counts.
StridedImage<float> blobs(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  StridedImage<float> frame(width, height, std::nanf(""));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool warm = (x / 7 + y / 9) % 2 == 0;
      frame.view()(x, y) =
          static_cast<float>(200 + (warm ? 6 * kSigma : 0) + kSigma * normal(random));
    }
  }
  return frame;
}

// What edge pixels are, from the response and the direction that were found, bit by bit; and from
// the fine derivative in double precision, which may be too near to call.
class PlainEdges {
 public:
  PlainEdges(const OrientedFilterResult& found, const MirroredFrame& frame,
             const OrientedFilterOptions& options, int sides)
      : found_(found), options_(options), sides_(sides) {
    const int width = found.response.width();
    const int height = found.response.height();
    Image<PlainClass> classes(width, height);
    fill_pixels(classes.view(), PlainClass::kNone);
    for (int y = 1; y + 1 < height; ++y) {
      for (int x = 1; x + 1 < width; ++x) {
        const float at = found.response(x, y);
        if (at > static_cast<float>(options.low) && at >= across(x, y, 1) &&
            at > across(x, y, -1)) {
          classes(x, y) = class_of(x, y);
        }
      }
    }
    if (options.fine_px > 0) {
      merge_fine(frame, classes);
    }
    edges = plain_hysteresis(std::move(classes), 1);
  }

  // The response over that of the lower pair of sides, 4 (and 8) px away along the normal.
  [[nodiscard]] float suppressed_response(int x, int y) const {
    const int own = found_.direction(x, y);
    const auto at = [&](int distance) {
      const int side_x =
          detail::mirrored(x + static_cast<int>(std::lround(-distance * std::sin(angle_of(own)))),
                           found_.response.width());
      const int side_y =
          detail::mirrored(y + static_cast<int>(std::lround(distance * std::cos(angle_of(own)))),
                           found_.response.height());
      const int turn = std::abs(found_.direction(side_x, side_y) - own);
      return std::min(turn, kOrientations - turn) <= 3 ? found_.response(side_x, side_y) : 0.0F;
    };
    float least = at(4) + at(-4);
    if (sides_ == 2) {
      least = std::min(least, at(8) + at(-8));
    }
    const float over = found_.response(x, y) - 0.5F * least;
    if (over < 0.4F * found_.response(x, y)) {
      return 0;  // a slope
    }
    const float ripple = 0.04F * largest_around(x, y);
    return over / std::sqrt(1 + ripple * ripple);
  }

  Image<std::uint8_t> edges;
  bool too_near = false;  // to call: then `edges` means nothing

 private:
  // Between the two neighbours where the normal, or its opposite, leaves the ring of eight.
  [[nodiscard]] float across(int x, int y, int sign) const {
    const double angle = angle_of(found_.direction(x, y) % (kOrientations / 2));
    const double nx = -sign * std::sin(angle);
    const double ny = sign * std::cos(angle);
    const int step_x = nx < 0 ? -1 : 1;
    const int step_y = ny < 0 ? -1 : 1;
    const bool flat = std::abs(nx) > std::abs(ny) - 1e-9;
    const double longer = std::max(std::abs(nx), std::abs(ny));
    const auto share = static_cast<float>(std::min(std::abs(nx), std::abs(ny)) / longer);
    const float side = found_.response(flat ? x + step_x : x, flat ? y : y + step_y);
    // Along an axis the other neighbour does not count, on whichever side it lies.
    return share < 1e-6F ? side : side + share * (found_.response(x + step_x, y + step_y) - side);
  }

  // Within 10 px across and down.
  [[nodiscard]] float largest_around(int x, int y) const {
    float largest = 0;
    for (int j = -10; j <= 10; ++j) {
      for (int i = -10; i <= 10; ++i) {
        if (found_.response.contains(x + i, y + j)) {
          largest = std::max(largest, found_.response(x + i, y + j));
        }
      }
    }
    return largest;
  }

  [[nodiscard]] PlainClass class_of(int x, int y) const {
    const float over = suppressed_response(x, y);
    return over > static_cast<float>(options_.high)  ? PlainClass::kStrong
           : over > static_cast<float>(options_.low) ? PlainClass::kWeak
                                                     : PlainClass::kNone;
  }

  // Near what the fine derivative finds only that is an edge.
  void merge_fine(const MirroredFrame& frame, Image<PlainClass>& classes) {
    const Image<std::uint8_t> fine = fine_edges(frame);
    for (int y = 0; y < fine.height(); ++y) {
      for (int x = 0; x < fine.width(); ++x) {
        for (int j = -2; j <= 2; ++j) {
          for (int i = -2; i <= 2; ++i) {
            if (fine(x, y) != 0 && i * i + j * j <= 4 && fine.view().contains(x + i, y + j)) {
              classes(x + i, y + j) = PlainClass::kNone;
            }
          }
        }
      }
    }
    for (int y = 0; y < fine.height(); ++y) {
      for (int x = 0; x < fine.width(); ++x) {
        if (fine(x, y) != 0) {
          classes(x, y) = class_of(x, y);
        }
      }
    }
  }

  // Canny's design on the fine derivative: directions rounded to 45 degrees, groups of 8 px.
  Image<std::uint8_t> fine_edges(const MirroredFrame& frame) {
    const PlainKernel along_x = round_kernel(true, options_.fine_px);
    const PlainKernel along_y = round_kernel(false, options_.fine_px);
    const int width = found_.response.width();
    const int height = found_.response.height();
    Image<double> gx(width, height), gy(width, height), magnitude(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        gx(x, y) = frame.response(along_x, x, y);
        gy(x, y) = frame.response(along_y, x, y);
        magnitude(x, y) = std::hypot(gx(x, y), gy(x, y));
      }
    }
    // Errors of two magnitudes, each that of both derivatives and of rounding it.
    const double near = 4 * frame.error_of(along_x);
    const auto is_above = [&](double a, double b) {
      too_near = too_near || std::abs(a - b) <= near;
      return a > b;
    };
    const double high = options_.fine_above * kSigma * noise_gain(along_x);
    const double tan_22_5 = std::numbers::sqrt2 - 1;
    Image<PlainClass> classes(width, height);
    fill_pixels(classes.view(), PlainClass::kNone);
    for (int y = 1; y + 1 < height; ++y) {
      for (int x = 1; x + 1 < width; ++x) {
        if (!is_above(magnitude(x, y), 0.6 * high)) {
          continue;
        }
        const bool flat = is_above(tan_22_5 * std::abs(gx(x, y)), std::abs(gy(x, y)));
        const bool steep = is_above(tan_22_5 * std::abs(gy(x, y)), std::abs(gx(x, y)));
        const int step_x = steep ? 0 : 1;
        const int step_y = flat ? 0 : (gx(x, y) < 0) == (gy(x, y) < 0) || steep ? 1 : -1;
        const int before = step_y < 0 || (step_y == 0 && step_x < 0) ? 1 : -1;
        if (is_above(magnitude(x, y), magnitude(x + before * step_x, y + before * step_y)) &&
            is_above(magnitude(x, y), magnitude(x - before * step_x, y - before * step_y))) {
          classes(x, y) = is_above(magnitude(x, y), high) ? PlainClass::kStrong : PlainClass::kWeak;
        }
      }
    }
    return plain_hysteresis(std::move(classes), 8);
  }

  const OrientedFilterResult& found_;
  const OrientedFilterOptions& options_;
  int sides_;
};

struct Case {
  double noisiness;
  double fine_px;
  OrientedFilterOptions options;
};

class OrientedFilter : public testing::Test {
 protected:
  static std::vector<Case> cases() {
    OrientedFilterOptions wide;
    wide.across_px = 2;
    wide.along_px = 3;
    wide.clean_across_px = wide.clean_along_px = 0.58;
    wide.fine_above = 3;
    wide.low = 0.7;
    wide.high = 1.1;
    std::vector<Case> cases = {{0, 0.8, {}}, {0.3, 0, {}}, {0.5, 0.8, {}},
                               {1, 0, {}},   {0, 0, wide}, {1, 1.5, wide}};
    for (Case& each : cases) {
      each.options.fine_px = each.fine_px;
    }
    return cases;
  }

  void check_size(const Case& chosen, int width, int height) {
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height) + ", noisiness " +
                 std::to_string(chosen.noisiness));
    const StridedImage<float> frame =
        blobs(width, height, static_cast<unsigned>(100 * width + height));
    const KernelSize size = kernel_size(chosen.options, chosen.noisiness);
    const auto kernels = oriented_kernels(size);
    const MirroredFrame mirrored(frame.view(), std::max(kernels[0].reach, 7));
    std::vector<Image<double>> responses;
    for (const PlainKernel& kernel : kernels) {
      Image<double>& response = responses.emplace_back(width, height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          response(x, y) = mirrored.response(kernel, x, y) / kSigma;
        }
      }
    }
    OrientedFilterBank filter(chosen.options);
    for_each_simd_target([&](const std::string&) {
      ParallelRunner& runner = *runners_[next_runner_++ % runners_.size()];
      const auto found = filter.run(frame.view(), kSigma, chosen.noisiness, runner);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->kernel.across_px, size.across_px);
      EXPECT_EQ(found->kernel.along_px, size.along_px);
      expect_responses(*found, responses, kernels, mirrored);
      const PlainEdges plain(*found, mirrored, chosen.options, chosen.noisiness < 0.5 ? 1 : 2);
      expect_edges(*found, plain);
    });
  }

  void expect_responses(const OrientedFilterResult& found,
                        const std::vector<Image<double>>& responses,
                        const std::vector<PlainKernel>& kernels, const MirroredFrame& frame) {
    double allowed = 0;
    for (const PlainKernel& kernel : kernels) {
      allowed = std::max(allowed, frame.error_of(kernel) / kSigma);
    }
    for (int y = 0; y < found.response.height(); ++y) {
      for (int x = 0; x < found.response.width(); ++x) {
        double largest = 0;
        for (const Image<double>& response : responses) {
          largest = std::max(largest, response(x, y));
        }
        const double error = std::abs(static_cast<double>(found.response(x, y)) - largest);
        ASSERT_LE(error, allowed) << x << ", " << y;
        largest_error_ = std::max(largest_error_, error / allowed);
        const int direction = found.direction(x, y);
        ASSERT_TRUE(direction >= 0 && direction < kOrientations);
        ASSERT_GE(responses[static_cast<std::size_t>(direction)](x, y), largest - 2 * allowed)
            << x << ", " << y << ": direction " << direction;
      }
    }
  }

  void expect_edges(const OrientedFilterResult& found, const PlainEdges& plain) {
    ++frames_;
    if (plain.too_near) {
      ++too_near_;
      return;
    }
    ASSERT_TRUE(same_pixels<std::uint8_t>(found.edges, plain.edges));
    for (int y = 0; y < found.edges.height(); ++y) {
      for (int x = 0; x < found.edges.width(); ++x) {
        if (found.edges(x, y) != 0) {
          ++edge_pixels_;
          ASSERT_EQ(found.suppressed_response(x, y), plain.suppressed_response(x, y))
              << x << ", " << y;
        }
      }
    }
  }

  std::vector<std::unique_ptr<ParallelRunner>> runners_ = all_runners();
  std::size_t next_runner_ = 0;
  double largest_error_ = 0;  // as a share of what is allowed
  int frames_ = 0, too_near_ = 0, edge_pixels_ = 0;
};

TEST_F(OrientedFilter, IsConvolutionWithTheBestOf24KernelsForAllSmallSizes) {
  const auto all = cases();
  std::size_t next = 0;
  for (int height = 1; height <= 12; ++height) {
    for (int width = 1; width <= 19; ++width) {
      check_size(all[next++ % all.size()], width, height);
    }
  }
  EXPECT_GT(edge_pixels_, 1000);
  EXPECT_LE(too_near_, frames_ / 20);
}

// Vectors, bands of rows, and fine groups of more than a few pixels.
TEST_F(OrientedFilter, IsThatAcrossVectorsAndBandsToo) {
  for (const Case& each : cases()) {
    check_size(each, 37, 33);
    check_size(each, 33, 65);
  }
  EXPECT_GT(edge_pixels_, 1000);
  EXPECT_LE(too_near_, frames_ / 4);
  // The bound on the errors is not much wider than what happens.
  RecordProperty("largest_error", std::to_string(largest_error_));
  EXPECT_GT(largest_error_, 0.03);
}

}  // namespace
}  // namespace thermedge::test
