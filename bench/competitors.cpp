#include "competitors.hpp"

#include <fmt/core.h>

#include <memory>
#include <utility>

#include "peers/classical.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/frame_denoiser.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/noise.hpp"
#include "value_or_exit.hpp"
#ifdef THERMEDGE_BENCH_OPENCV
#include "peers/opencv_canny.hpp"
#include "peers/opencv_edge_drawing.hpp"
#include "peers/opencv_filters.hpp"
#include "peers/opencv_lsd.hpp"
#endif

namespace thermedge::bench {
namespace {

using Counts = ImageView<const std::uint16_t>;
using Levels = ImageView<const std::uint8_t>;
using Map = ImageView<std::uint8_t>;

constexpr GreyScaleOptions kScale;

// Algorithm 1, then a filter of levels.
[[maybe_unused]] FrontEnd front(std::string name, const std::function<void(Levels, Map)>& filter) {
  return {std::move(name), [filter](Counts counts, Map levels) {
            Image<std::uint8_t> plain(counts.width(), counts.height());
            value_or_exit(scale_to_8bit(counts, kScale, plain));
            filter(plain, levels);
          }};
}

FrontEnd front_without_filter() {
  return {"none",
          [](Counts counts, Map levels) { value_or_exit(scale_to_8bit(counts, kScale, levels)); }};
}

// Counts without their noise, then Algorithm 1.
FrontEnd thermedge_denoiser(std::string name, DenoiseMethod method) {
  return {std::move(name), [method](Counts counts, Map levels) {
            FrameDenoiserOptions options;
            options.denoise = {};
            options.denoise.method = method;
            FrameDenoiser denoiser(options);
            value_or_exit(scale_to_8bit(value_or_exit(denoiser.run(counts, *make_runner(1))),
                                        kScale, levels));
          }};
}

Finder classical_finder(ClassicalMethod method, double threshold) {
  return {threshold == 0 ? "automatic" : fmt::format("threshold {}", threshold),
          [=](Levels levels, Map map) { classical(levels, method, threshold, map); }};
}

std::vector<Finder> classical_finders(ClassicalMethod method) {
  // Canny's is of a gradient that is 8 times as large.
  const double unit = method == ClassicalMethod::kLog     ? 1.0 / 16
                      : method == ClassicalMethod::kCanny ? 8
                                                          : 1;
  std::vector<Finder> finders;
  for (const double threshold : {0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    finders.push_back(classical_finder(method, threshold * unit));
  }
  return finders;
}

// There are two detectors of this name.
std::string display_name(const ClassicalName& method) {
  return std::string(method.display) +
         (method.method == ClassicalMethod::kCanny ? " of MATLAB" : "");
}

#ifdef THERMEDGE_BENCH_OPENCV
std::vector<FrontEnd> gaussian_fronts(std::initializer_list<double> sigmas_px) {
  std::vector<FrontEnd> fronts;
  for (const double sigma : sigmas_px) {
    fronts.push_back(front(fmt::format("Gaussian {} px", sigma),
                           [sigma](Levels in, Map out) { opencv_blur(in, sigma, out); }));
  }
  return fronts;
}

std::vector<FrontEnd> median_fronts() {
  std::vector<FrontEnd> fronts;
  for (const int size : {3, 5, 7, 11, 15}) {
    fronts.push_back(front(fmt::format("median {} px", size),
                           [size](Levels in, Map out) { opencv_median(in, size, out); }));
  }
  return fronts;
}

std::vector<FrontEnd> nlm_fronts() {
  std::vector<FrontEnd> fronts;
  for (const double h : {3.0, 6.0, 10.0, 16.0, 24.0}) {
    fronts.push_back(front(fmt::format("NL-means h {}", h),
                           [h](Levels in, Map out) { opencv_nlm_of_levels(in, h, out); }));
  }
  return fronts;
}

std::vector<Finder> canny_finders() {
  std::vector<Finder> finders;
  for (const double high : {3.0, 4.5, 7.0, 10.0, 15.0, 22.0, 32.0, 48.0, 70.0, 100.0}) {
    finders.push_back({fmt::format("high {}", high),
                       [high](Levels levels, Map map) { opencv_canny(levels, high, map); }});
  }
  return finders;
}

std::vector<Finder> edge_drawing_finders() {
  std::vector<Finder> finders;
  for (const int threshold : {2, 4, 6, 8, 11, 15, 20, 30}) {
    finders.push_back({fmt::format("gradient {}", threshold), [threshold](Levels levels, Map map) {
                         opencv_edge_drawing(levels, threshold, map);
                       }});
  }
  return finders;
}

std::vector<Finder> one_finder(void (*run)(Levels, Map)) { return {{"defaults", run}}; }

std::vector<Competitor> opencv_competitors() {
  const auto blurs = [] { return gaussian_fronts({0.7, 1.0, 1.5, 2.0, 3.0, 4.0}); };
  return {{"Canny after Gaussian", "OpenCV", {}, blurs(), canny_finders()},
          {"Canny after median", "OpenCV", {}, median_fronts(), canny_finders()},
          {"Canny after NL-means", "OpenCV", {}, nlm_fronts(), canny_finders()},
          {"Edge Drawing", "OpenCV", {}, blurs(), edge_drawing_finders()},
          {"EDPF", "OpenCV", {}, blurs(), one_finder(opencv_edpf)},
          {"LSD", "OpenCV", {}, blurs(), one_finder(opencv_lsd)}};
}
#endif

}  // namespace

std::string Competitor::setting_name(std::size_t setting) const {
  if (whole) {
    return "defaults";
  }
  return fronts[setting / finders.size()].name + " " + finders[setting % finders.size()].name;
}

void Competitor::run(std::size_t setting, ImageView<const std::uint16_t> counts,
                     ImageView<std::uint8_t> map) const {
  if (whole) {
    whole(counts, map);
    return;
  }
  Image<std::uint8_t> levels(counts.width(), counts.height());
  fronts[setting / finders.size()].run(counts, levels);
  finders[setting % finders.size()].run(levels, map);
}

WholeDetector thermedge_detector(const DetectorOptions& options) {
  DetectorOptions on_one_thread = options;
  on_one_thread.threads = 1;
  const auto detector = std::make_shared<Detector>(value_or_exit(Detector::create(on_one_thread)));
  return [detector](Counts counts, Map map) {
    draw_mask(value_or_exit(detector->detect(counts)).edges, map);
  };
}

std::vector<Competitor> all_competitors() {
  std::vector<Competitor> all;
  all.reserve(16);
  for (const auto& preset : kPresets) {
    all.push_back({"thermedge " + std::string(preset.name),
                   "thermedge",
                   thermedge_detector(DetectorOptions(preset.value)),
                   {},
                   {}});
  }
#ifdef THERMEDGE_BENCH_OPENCV
  for (Competitor& peer : opencv_competitors()) {
    all.push_back(std::move(peer));
  }
#endif
  for (const ClassicalName& method : kClassicalMethods) {
    Competitor competitor{display_name(method), "classical", {}, {}, {}};
    competitor.fronts = {front_without_filter(),
                         thermedge_denoiser("Gaussian 5x5", DenoiseMethod::kGaussian)};
    competitor.finders = classical_finders(method.method);
    all.push_back(std::move(competitor));
  }
  return all;
}

std::vector<FrontEnd> denoising_fronts() {
  std::vector<FrontEnd> fronts;
  fronts.push_back(front_without_filter());
  fronts.push_back(thermedge_denoiser("Gaussian", DenoiseMethod::kGaussian));
#ifdef THERMEDGE_BENCH_OPENCV
  fronts.push_back(front("median", [](Levels in, Map out) { opencv_median(in, 5, out); }));
  fronts.push_back({"bilateral", [](Counts counts, Map levels) {
                      Image<std::uint8_t> plain(counts.width(), counts.height());
                      value_or_exit(scale_to_8bit(counts, kScale, plain));
                      opencv_bilateral(plain, 3 * sigma_levels(counts), 2, levels);
                    }});
#endif
  fronts.push_back(thermedge_denoiser("NL-means", DenoiseMethod::kNlm));
  fronts.push_back(thermedge_denoiser("BM3D", DenoiseMethod::kBm3d));
  return fronts;
}

std::vector<Competitor> detectors_on_levels() {
  std::vector<Competitor> all;
  all.reserve(16);
  for (const ClassicalName& method : kClassicalMethods) {
    all.push_back({display_name(method), "classical", {}, {}, classical_finders(method.method)});
  }
#ifdef THERMEDGE_BENCH_OPENCV
  all.push_back({"OpenCV Canny", "OpenCV", {}, {}, canny_finders()});
  all.push_back({"Edge Drawing", "OpenCV", {}, {}, edge_drawing_finders()});
  all.push_back({"EDPF", "OpenCV", {}, {}, one_finder(opencv_edpf)});
  all.push_back({"LSD", "OpenCV", {}, {}, one_finder(opencv_lsd)});
#endif
  return all;
}

std::vector<Competitor> peers_for_detection() {
#ifdef THERMEDGE_BENCH_OPENCV
  std::vector<Finder> cannies;
  double high = 4;
  for (int i = 0; i < 45; ++i, high *= 1.1) {  // up to 265
    cannies.push_back({fmt::format("high {:.1f}", high),
                       [high](Levels levels, Map map) { opencv_canny(levels, high, map); }});
  }
  return {{"OpenCV Canny", "OpenCV", {}, gaussian_fronts({1.5, 2.0, 3.0, 4.0}), cannies},
          {"OpenCV EDPF",
           "OpenCV",
           {},
           gaussian_fronts({0.7, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0}),
           one_finder(opencv_edpf)}};
#else
  return {};
#endif
}

}  // namespace thermedge::bench
