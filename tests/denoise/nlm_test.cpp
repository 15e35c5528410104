// Non-local means against its definition in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "float_frame.hpp"
#include "nlm_simd.hpp"
#include "support/images.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge {
namespace {

// Weight of a patch's pixel at distance `i` from its middle, along one side.
int side_weight(int patch_px, int i) { return (patch_px + 1) / 2 - std::abs(i); }

// The displacements looked at: a disc, thinned beyond half its radius.
bool is_sampled(int dx, int dy, int search_px) {
  const double radius = std::hypot(dx, dy);
  const int reach = search_px / 2;
  return radius < reach + 0.5 && (radius <= reach / 2.0 || (dx % 2 == 0 && dy % 2 == 0));
}

// The kernel's integer distance of the patches around (x, y) and (x + dx, y + dy), in coordinates
// of the padded image.
int integer_distance(ImageView<const std::uint16_t> levels, int patch_px, int x, int y, int dx,
                     int dy) {
  const int r = patch_px / 2;
  std::int64_t sum = 0;
  for (int j = -r; j <= r; ++j) {
    for (int i = -r; i <= r; ++i) {
      const auto wrapped =
          static_cast<std::int16_t>(levels(x + i, y + j) - levels(x + i + dx, y + j + dy));
      const int level = std::min(std::abs(static_cast<int>(wrapped)), 255);
      sum += std::int64_t{side_weight(patch_px, i)} * side_weight(patch_px, j) * level * level;
    }
  }
  return static_cast<int>(std::min<std::int64_t>(sum, detail::kLargestDistance));
}

struct KernelCase {
  int width = 0;
  int height = 0;
  int patch_px = 0;
  int search_px = 0;
};

class NlmKernelTest : public testing::TestWithParam<KernelCase> {};

TEST_P(NlmKernelTest, AgreesWithTheDefinitionOnEveryTarget) {
  const int width = GetParam().width;
  const int height = GetParam().height;
  const int patch = GetParam().patch_px;
  const int search = GetParam().search_px;
  const int margin = patch / 2 + search / 2;
  Image<float> values = test::noise_image<float>(width + 2 * margin, height + 2 * margin, 0, 2, 3);
  Image<std::uint16_t> levels(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      // Some beyond the clamp of 255, some around the wrap at 2^16.
      const float scale = x % 11 == 0 ? 200.0F : 4.0F;
      levels(x, y) = static_cast<std::uint16_t>(std::lrint(values(x, y) * scale));
    }
  }
  // Flat enough that a weight just below the largest distance shows.
  const detail::NlmWeights weigh{1200.0F, 1.0F / 6000.0F};
  test::for_each_simd_target([&](const std::string&) {
    Image<std::uint16_t> boxes(values.width() + detail::kNlmSlack,
                               detail::nlm_box_rows(height, patch));
    Image<float> sums(width + detail::kNlmSlack, height);
    Image<float> weights(width + detail::kNlmSlack, height);
    detail::nlm_band({values, levels, boxes, sums, weights, 0, width}, patch, search, weigh);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        double total = 0;
        for (int dy = -search / 2; dy <= search / 2; ++dy) {
          for (int dx = -search / 2; dx <= search / 2; ++dx) {
            if (!is_sampled(dx, dy, search)) {
              continue;
            }
            const int distance = integer_distance(levels, patch, x + margin, y + margin, dx, dy);
            const double weight = distance == detail::kLargestDistance
                                      ? 0
                                      : std::exp2(-std::max(distance - 1200.0, 0.0) / 6000.0);
            sum += weight * values(x + margin + dx, y + margin + dy);
            total += weight;
          }
        }
        ASSERT_NEAR(weights(x, y), total, 1.2e-4 * total) << x << ", " << y;
        ASSERT_NEAR(sums(x, y), sum, 1e-3 * total) << x << ", " << y;
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Shapes, NlmKernelTest,
                         testing::Values(KernelCase{1, 1, 7, 21}, KernelCase{9, 3, 1, 5},
                                         KernelCase{16, 2, 3, 3}, KernelCase{33, 4, 5, 7},
                                         KernelCase{17, 5, 7, 9}, KernelCase{40, 2, 15, 1}));

// The filter's definition, without integers.
Image<double> nlm_reference(ImageView<const float> in, double sigma, const NlmOptions& options) {
  const int r = options.patch_px / 2;
  const int s = options.search_px / 2;
  const auto pixel = [&](int x, int y) {
    return static_cast<double>(
        in(detail::mirrored(x, in.width()), detail::mirrored(y, in.height())));
  };
  Image<double> out(in.width(), in.height());
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      double sum = 0;
      double total = 0;
      for (int dy = -s; dy <= s; ++dy) {
        for (int dx = -s; dx <= s; ++dx) {
          if (!is_sampled(dx, dy, options.search_px)) {
            continue;
          }
          double distance = 0;
          double patch_weight = 0;
          for (int j = -r; j <= r; ++j) {
            for (int i = -r; i <= r; ++i) {
              const double w = side_weight(options.patch_px, i) * side_weight(options.patch_px, j);
              const double difference = pixel(x + i, y + j) - pixel(x + i + dx, y + j + dy);
              distance += w * difference * difference;
              patch_weight += w;
            }
          }
          distance /= patch_weight * sigma * sigma;
          const double h = options.h_over_sigma;
          const double weight = std::exp(-std::max(distance - 2, 0.0) / (h * h));
          sum += weight * pixel(x + dx, y + dy);
          total += weight;
        }
      }
      out(x, y) = sum / total;
    }
  }
  return out;
}

// Noise on a step and a ramp.
Image<float> step_image(int width, int height, double sigma) {
  Image<float> image = test::noise_image<float>(width, height, 8000, sigma, 17);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) += static_cast<float>((x > width / 2 ? 8 * sigma : 0) + 0.3 * sigma * y);
    }
  }
  return image;
}

TEST(NlmTest, IsWithinRoundingOfTheDefinition) {
  const auto runner = make_runner(1);
  constexpr double kSigma = 40;
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 5}, {13, 1}, {12, 11}, {37, 19}}) {
    for (const int patch : {1, 3, 7, 15}) {
      DenoiseOptions options;
      options.method = DenoiseMethod::kNlm;
      options.nlm.patch_px = patch;
      options.nlm.search_px = 9;
      const Image<float> in = step_image(width, height, kSigma);
      const Image<double> expected = nlm_reference(in, kSigma, options.nlm);
      test::GuardedImage<float> out(width, height);
      ASSERT_TRUE(Denoiser(options).run(in, kSigma, out.view(), *runner));
      ASSERT_TRUE(out.intact());
      double squares = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double error = (out.view()(x, y) - expected(x, y)) / kSigma;
          squares += error * error;
        }
      }
      // The 15-pixel patch leaves about one level to a sigma.
      EXPECT_LT(std::sqrt(squares / (width * height)), patch < 15 ? 0.04 : 0.1)
          << width << " x " << height << ", patch " << patch;
    }
  }
}

}  // namespace
}  // namespace thermedge
