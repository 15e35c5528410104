// How good a picture `thermedge denoise` makes by default.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "support/images.hpp"
#include "support/program.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

class DenoiseProgram : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(THERMEDGE_PROGRAM).empty()) {
      GTEST_SKIP() << "the program was not built (THERMEDGE_BUILD_CLI)";
    }
  }

  // What `arguments` make of a frame, in its counts.
  Image<std::uint16_t> denoised(const std::string& input, const std::string& arguments = "") {
    const auto result = run_program("denoise '" + input + "' -o x.png " + arguments, directory_);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return counts_of(directory_ / "x.png");
  }

  static Image<std::uint16_t> counts_of(const fs::path& path) {
    auto picture = io::read_picture(path.string());
    EXPECT_TRUE(picture);
    return std::move(picture->counts);
  }

  // Mean square of scale * (a - offset) - b.
  static double mean_square(const Image<std::uint16_t>& a, double scale, double offset,
                            const Image<std::uint16_t>& b) {
    double sum = 0;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        const double difference = scale * (a(x, y) - offset) - b(x, y);
        sum += difference * difference;
      }
    }
    return sum / static_cast<double>(a.view().size());
  }

  TemporaryDirectory temporary_;
  const fs::path& directory_ = temporary_.path();
};

// Dead leaves, whose statistics are those of photographs: discs of all sizes, many small ones, that
// hide each other.
Image<float> dead_leaves(int width, int height) {
  Image<float> frame(width, height);
  fill_pixels(frame.view(), 8000.0F);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> level(8000, 60);
  for (int leaf = 0; leaf < 20000; ++leaf) {
    const double radius = 1.2 / std::sqrt(1 - 0.998 * uniform(random));
    const double centre_x = width * uniform(random);
    const double centre_y = height * uniform(random);
    const auto value = static_cast<float>(level(random));
    const int reach = static_cast<int>(radius) + 1;
    const int left = static_cast<int>(centre_x) - reach;
    const int top = static_cast<int>(centre_y) - reach;
    for (int y = std::max(top, 0); y < std::min(top + 2 * reach + 2, height); ++y) {
      for (int x = std::max(left, 0); x < std::min(left + 2 * reach + 2, width); ++x) {
        if (std::hypot(x - centre_x, y - centre_y) < radius) {
          frame(x, y) = value;
        }
      }
    }
  }
  return frame;
}

TEST_F(DenoiseProgram, KeepsMoreDetailThanTheSettingsForEdges) {
  constexpr int kWidth = 128;
  constexpr int kHeight = 96;
  const Image<float> scene = dead_leaves(kWidth, kHeight);
  const auto noise = noise_image<float>(kWidth, kHeight, 0, 20, 3);
  Image<std::uint16_t> clean(kWidth, kHeight);
  Image<std::uint16_t> noisy(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      clean(x, y) = static_cast<std::uint16_t>(std::lround(scene(x, y)));
      noisy(x, y) = static_cast<std::uint16_t>(std::lround(scene(x, y) + noise(x, y)));
    }
  }
  const std::string file = (directory_ / "noisy.png").string();
  ASSERT_TRUE(io::write_picture(file, ImageView<const std::uint16_t>(noisy)));
  const auto error = [&](const std::string& arguments) {
    return std::sqrt(mean_square(denoised(file, arguments), 1, 0, clean));
  };
  const double by_default = error("");
  const double for_edges = error(
      "--set denoise.sigma_scale=1.2 --set denoise.detrend=true "
      "--set denoise.bilateral.range_sigmas=0.2 --set denoise.bm3d.profile=balanced "
      "--set denoise.bm3d.adjacent_blocks=false");
  EXPECT_LT(by_default, 0.85 * for_edges);
  EXPECT_LT(by_default, 0.85 * 20);
}

// The mean PSNR of the IPOL implementation over the three photographs, less 0.10 dB; with the noise
// told and as measured. Frames hold 16 v + 8000 for the grey levels v.
TEST_F(DenoiseProgram, IsAsGoodAsTheReferenceOnPhotographs) {
  THERMEDGE_NEEDS_SHARED("data/denoise");
  const fs::path photographs = shared_directory() / "data" / "denoise";
  struct Case {
    int sigma;
    double reference_db;
  };
  for (const auto& [sigma, reference_db] : {Case{10, 33.190}, {25, 28.541}, {50, 25.720}}) {
    for (const std::string& told : {"--sigma " + std::to_string(16 * sigma), std::string()}) {
      double mean_db = 0;
      for (const std::string name : {"b100007", "b107072", "b134049"}) {
        const auto clean = counts_of(photographs / "clean" / (name + ".png"));
        const auto noisy = photographs / "noisy" / (name + "_s" + std::to_string(sigma) + ".png");
        const double error = mean_square(denoised(noisy.string(), told), 1.0 / 16, 8000, clean);
        mean_db += 10 * std::log10(255.0 * 255.0 / error) / 3;
      }
      EXPECT_GE(mean_db, reference_db - 0.10) << "sigma " << sigma << " " << told;
    }
  }
}

}  // namespace
}  // namespace thermedge::test
