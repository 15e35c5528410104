// Time and quality of the denoisers, side by side with OpenCV's. Writes a CSV; --help tells how to
// call it.
#include <fmt/core.h>
#include <fmt/os.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "thermedge/io/source.hpp"
#include "thermedge/options.hpp"
#include "thermedge/sim/scene.hpp"
#include "thermedge/simd.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "value_or_exit.hpp"
#ifdef THERMEDGE_BENCH_OPENCV
#include "peers/opencv_gaussian.hpp"
#include "peers/opencv_nlm.hpp"
#endif

namespace thermedge::bench {
namespace {

constexpr std::array kSigmas = {10, 25, 50};  // grey levels
constexpr int kRounds = 11;
constexpr int kRoundsOfSlowOnes = 3;
constexpr double kSlowMs = 100;
constexpr double kTimedSigma = 25;

struct Picture {
  Image<float> clean;  // grey levels, 0..255
  std::map<int, Image<float>> noisy;
};
struct PictureSet {
  std::string name;
  std::vector<Picture> pictures;
};

// Grey levels of a simulated scene: its counts from the least to the largest.
Picture simulated(const std::string& scene, int width, int height) {
  sim::SceneOptions options;
  options.name = scene;
  options.camera.width = width;
  options.camera.height = height;
  const Image<float> counts = std::move(sim::render(options, 0).value().clean);
  const auto [low, high] = [&] {
    float least = counts(0, 0), most = least;
    for (int y = 0; y < height; ++y) {
      least = std::min(least, *std::min_element(counts.row(y), counts.row(y) + width));
      most = std::max(most, *std::max_element(counts.row(y), counts.row(y) + width));
    }
    return std::pair{least, most};
  }();
  Picture picture;
  picture.clean.resize(width, height);
  for (const int sigma : kSigmas) {
    Image<float> noisy(width, height);
    std::mt19937 random(static_cast<unsigned>(sigma));
    std::normal_distribution<float> normal(0, static_cast<float>(sigma));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        picture.clean(x, y) = 255 * (counts(x, y) - low) / (high - low);
        noisy(x, y) = picture.clean(x, y) + normal(random);
      }
    }
    picture.noisy[sigma] = std::move(noisy);
  }
  return picture;
}

Image<float> read_levels(const std::filesystem::path& file, float offset, float scale) {
  const Image<std::uint16_t> counts = std::move(io::read_picture(file.string()).value().counts);
  Image<float> levels(counts.width(), counts.height());
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      levels(x, y) = (static_cast<float>(counts(x, y)) - offset) * scale;
    }
  }
  return levels;
}

PictureSet photographs(const std::filesystem::path& directory) {
  PictureSet set{"photographs", {}};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "clean")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    Picture picture;
    picture.clean = read_levels(file, 0, 1);
    for (const int sigma : kSigmas) {
      const std::string name = fmt::format("{}_s{}.png", file.stem().string(), sigma);
      picture.noisy[sigma] = read_levels(directory / "noisy" / name, 8000, 1.0F / 16);
    }
    set.pictures.push_back(std::move(picture));
  }
  return set;
}

double psnr(ImageView<const float> clean, ImageView<const float> out) {
  double squares = 0;
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      squares += std::pow(out(x, y) - clean(x, y), 2);
    }
  }
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(out.size()) / squares);
}

using Filter = std::function<void(ImageView<const float> in, double sigma, ImageView<float> out)>;

struct Competitor {
  [[nodiscard]] std::string name() const { return library + "," + method + "," + settings; }

  std::string library;
  std::string method;
  std::string settings;
  std::string simd;  // "" where it is not ours to choose
  int threads = 1;
  Filter filter;
};

Competitor thermedge_denoiser(const std::string& method, const std::string& settings,
                              const std::string& simd, int threads, const DenoiseOptions& options) {
  auto denoiser = std::make_shared<Denoiser>(options);
  auto runner = std::shared_ptr<ParallelRunner>(make_runner(threads));
  return {"thermedge",
          method,
          settings,
          simd,
          threads,
          [denoiser, runner](ImageView<const float> in, double sigma, ImageView<float> out) {
            if (const Status status = denoiser->run(in, sigma, out, *runner); !status) {
              fmt::print(stderr, "{}\n", status.error().message);
              std::exit(1);
            }
          }};
}

std::vector<Competitor> competitors() {
  std::vector<Competitor> all;
  for (const std::string& simd : simd_targets()) {
    for (const int threads : {1, 2}) {
      DenoiseOptions options;
      for (const auto& profile : kBm3dProfiles) {
        options.bm3d.profile = profile.value;
        all.push_back(
            thermedge_denoiser("BM3D", std::string(profile.name), simd, threads, options));
      }
      options.method = DenoiseMethod::kNlm;
      all.push_back(thermedge_denoiser("NL-means", "7/21", simd, threads, options));
      options.method = DenoiseMethod::kGaussian;
      all.push_back(thermedge_denoiser("Gaussian", "5x5", simd, threads, options));
      for (const double sigma_px : {1.0, 2.0, 4.0}) {
        options.gaussian.sigma_px = sigma_px;
        all.push_back(thermedge_denoiser("Gaussian", fmt::format("sigma {}", sigma_px), simd,
                                         threads, options));
      }
    }
  }
#ifdef THERMEDGE_BENCH_OPENCV
  for (const int threads : {1, 2}) {
    all.push_back({"OpenCV", "NL-means", "7/21", "", threads,
                   [threads](ImageView<const float> in, double sigma, ImageView<float> out) {
                     opencv_nlm(in, sigma, threads, out);
                   }});
    const auto gaussian = [threads](double sigma_px, int size_px) -> Filter {
      return [=](ImageView<const float> in, double, ImageView<float> out) {
        opencv_gaussian(in, sigma_px, size_px, threads, out);
      };
    };
    all.push_back({"OpenCV", "Gaussian", "5x5", "", threads, gaussian(1.4, 5)});
    for (const double sigma_px : {1.0, 2.0, 4.0}) {
      all.push_back({"OpenCV", "Gaussian", fmt::format("sigma {}", sigma_px), "", threads,
                     gaussian(sigma_px, 0)});
    }
  }
#endif
  return all;
}

// The mean over pictures for each sigma; fails where a filter does nothing against strong noise.
std::vector<double> quality(const Competitor& competitor, const PictureSet& set) {
  std::vector<double> means;
  for (const int sigma : kSigmas) {
    double sum = 0;
    for (const Picture& picture : set.pictures) {
      const Image<float>& noisy = picture.noisy.at(sigma);
      Image<float> out(noisy.width(), noisy.height());
      competitor.filter(noisy, sigma, out);
      const double gain = psnr(picture.clean, out) - psnr(picture.clean, noisy);
      if (sigma == kSigmas.back() && !(gain > 3)) {
        fmt::print(stderr, "{} {} {}: {:.2f} dB at sigma {} is no denoising\n", competitor.library,
                   competitor.method, competitor.settings, gain, sigma);
        std::exit(1);
      }
      sum += psnr(picture.clean, out);
    }
    means.push_back(sum / static_cast<double>(set.pictures.size()));
  }
  return means;
}

double ms_of(const Competitor& competitor, ImageView<const float> in, ImageView<float> out) {
  constexpr double kLeastMs = 10;  // enough repetitions for the clock
  double ms = 0;
  int runs = 0;
  for (runs = 0; ms < kLeastMs; ++runs) {
    const auto start = std::chrono::steady_clock::now();
    competitor.filter(in, kTimedSigma, out);
    ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  return ms / runs;
}

// Everybody once a round, so that a busy moment of the machine is shared; medians over the rounds.
std::vector<double> time_all(const std::vector<Competitor>& all, ImageView<const float> in) {
  std::vector<std::vector<double>> samples(all.size());
  Image<float> out(in.width(), in.height());
  for (int round = 0; round <= kRounds; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_slow = !samples[i].empty() && samples[i].back() > kSlowMs;
      if (is_slow && round > kRoundsOfSlowOnes) {
        continue;
      }
      const SimdScope scope(
          value_or_exit(SimdTarget::named(all[i].simd.empty() ? "auto" : all[i].simd)));
      if (!is_slow) {
        all[i].filter(in, kTimedSigma, out);  // its memory was last touched a round ago
      }
      const double ms = ms_of(all[i], in, out);
      if (round > 0) {  // the first warms up
        samples[i].push_back(ms);
      }
    }
  }
  std::vector<double> medians;
  for (auto& of_one : samples) {
    const auto middle = of_one.begin() + static_cast<std::ptrdiff_t>(of_one.size() / 2);
    std::nth_element(of_one.begin(), middle, of_one.end());
    medians.push_back(*middle);
  }
  return medians;
}

int run(const std::string& csv, const std::string& photograph_directory) {
  const std::vector<Competitor> all = competitors();
  std::vector<PictureSet> sets(1);
  sets[0].name = "simulated";
  for (const std::string scene : {"desk", "corridor"}) {
    sets[0].pictures.push_back(simulated(scene, 382, 288));
  }
  if (std::filesystem::is_directory(photograph_directory)) {
    sets.push_back(photographs(photograph_directory));
  } else {
    fmt::print("no photographs at '{}': quality on simulated scenes alone\n", photograph_directory);
  }
  auto file = fmt::output_file(csv);
  file.print("library,method,settings,simd,threads,width,height,ms,mpx_per_s");
  for (const PictureSet& set : sets) {
    for (const int sigma : kSigmas) {
      file.print(",psnr_{}_{}", set.name, sigma);
    }
  }
  file.print("\n");
  // The same for every SIMD target, number of threads and size of the timed frame.
  std::map<std::string, std::string> quality_columns;
  for (const Competitor& competitor : all) {
    std::string& columns = quality_columns[competitor.name()];
    if (!columns.empty()) {
      continue;
    }
    for (const PictureSet& set : sets) {
      for (const double mean : quality(competitor, set)) {
        columns += fmt::format(",{:.3f}", mean);
      }
    }
  }
  for (const auto& [width, height] : {std::pair{382, 288}, {640, 512}}) {
    const Picture picture = simulated("corridor", width, height);
    const std::vector<double> ms = time_all(all, picture.noisy.at(static_cast<int>(kTimedSigma)));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Competitor& competitor = all[i];
      const double mpx_per_s = width * height / ms[i] / 1000;
      file.print("{},{},{},{},{},{:.4f},{:.3f}{}\n", competitor.name(), competitor.simd,
                 competitor.threads, width, height, ms[i], mpx_per_s,
                 quality_columns[competitor.name()]);
      fmt::print("{:9} {:8} {:8} {:6} {} thread{} {}x{} {:9.3f} ms {:8.2f} Mpx/s\n",
                 competitor.library, competitor.method, competitor.settings, competitor.simd,
                 competitor.threads, competitor.threads == 1 ? ' ' : 's', width, height, ms[i],
                 mpx_per_s);
    }
  }
  return 0;
}

}  // namespace
}  // namespace thermedge::bench

int main(int argc, char** argv) {
  CLI::App app("Time and quality of the denoisers, side by side with OpenCV's");
  std::string csv;
  std::string photographs;
  app.add_option("OUT", csv, "the CSV file")->required();
  app.add_option("PHOTOGRAPHS", photographs,
                 "directory with clean/NAME.png (8 bits) and noisy/NAME_sSIGMA.png (16 * level + "
                 "8000); without it quality is measured on simulated scenes alone");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return thermedge::bench::run(csv, photographs);
}
