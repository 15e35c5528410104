#include "competitors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

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

Counts counts_of(const Frame& frame) { return std::get<Counts>(frame.pixels); }

// Counts -> 8-bit levels.
struct View {
  std::string name;
  std::function<void(Counts, Map)> run;
};

// Levels -> levels.
struct Filter {
  std::string name;
  std::function<void(Levels, Map)> run;
};

View algorithm_1() {
  return {"",
          [](Counts counts, Map levels) { value_or_exit(scale_to_8bit(counts, kScale, levels)); }};
}

[[maybe_unused]] FrontEnd front(const View& view, const Filter& filter) {
  return {view.name.empty() ? filter.name : view.name + " " + filter.name,
          [view, filter](Counts counts, Map levels) {
            Image<std::uint8_t> plain(counts.width(), counts.height());
            view.run(counts, plain);
            filter.run(plain, levels);
          }};
}

// Every view with every filter.
[[maybe_unused]] std::vector<FrontEnd> fronts(const std::vector<View>& views,
                                              const std::vector<Filter>& filters) {
  std::vector<FrontEnd> all;
  for (const View& view : views) {
    for (const Filter& filter : filters) {
      all.push_back(front(view, filter));
    }
  }
  return all;
}

FrontEnd front_without_filter() { return {"none", algorithm_1().run}; }

Image<std::uint16_t> denoised(Counts counts, DenoiseMethod method) {
  FrameDenoiserOptions options;
  options.denoise = {};
  options.denoise.method = method;
  FrameDenoiser denoiser(options);
  const auto result = value_or_exit(denoiser.run(counts, *make_runner(1)));
  Image<std::uint16_t> copy(counts.width(), counts.height());
  copy_pixels(ImageView<const std::uint16_t>(result), copy.view());
  return copy;
}

// Counts without their noise, then the view.
FrontEnd thermedge_denoiser(std::string name, DenoiseMethod method, const View& view) {
  return {std::move(name), [method, view](Counts counts, Map levels) {
            view.run(denoised(counts, method), levels);
          }};
}

// `levels_per_count` from the value that becomes the middle of the levels.
void to_levels(Counts counts, double middle, double levels_per_count, Map levels) {
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      const double level = 127.5 + (counts(x, y) - middle) * levels_per_count;
      levels(x, y) = static_cast<std::uint8_t>(std::clamp(std::round(level), 0.0, 255.0));
    }
  }
}

// The value that this share of the pixels does not exceed.
double percentile(Counts counts, double share) {
  std::vector<std::uint16_t> values;
  for (int y = 0; y < counts.height(); ++y) {
    values.insert(values.end(), counts.row(y), counts.row(y) + counts.width());
  }
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// The noise is as many levels in every frame; what is far from the median is cut off.
View view_in_noise(double sigma) {
  constexpr double kLevels = 4;
  return {fmt::format("{} levels a sigma", kLevels), [sigma](Counts counts, Map levels) {
            to_levels(counts, percentile(counts, 0.5), kLevels / sigma, levels);
          }};
}

View stretched_view() {
  return {"stretched", [](Counts counts, Map levels) {
            const double low = percentile(counts, 0.005);
            const double high = std::max(percentile(counts, 0.995), low + 1);
            to_levels(counts, (low + high) / 2, 255 / (high - low), levels);
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
std::vector<Filter> gaussian_filters(std::initializer_list<double> sigmas_px) {
  std::vector<Filter> filters;
  for (const double sigma : sigmas_px) {
    filters.push_back({fmt::format("Gaussian {} px", sigma),
                       [sigma](Levels in, Map out) { opencv_blur(in, sigma, out); }});
  }
  return filters;
}

std::vector<Filter> median_filters() {
  std::vector<Filter> filters;
  for (const int size : {3, 5, 7, 11, 15}) {
    filters.push_back({fmt::format("median {} px", size),
                       [size](Levels in, Map out) { opencv_median(in, size, out); }});
  }
  return filters;
}

std::vector<Filter> nlm_filters() {
  std::vector<Filter> filters;
  for (const double h : {3.0, 6.0, 10.0, 16.0, 24.0}) {
    filters.push_back({fmt::format("NL-means h {}", h),
                       [h](Levels in, Map out) { opencv_nlm_of_levels(in, h, out); }});
  }
  return filters;
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

std::vector<Competitor> opencv_competitors(const std::vector<View>& views) {
  const auto blurs = [&] {
    return fronts(views, gaussian_filters({0.7, 1.0, 1.5, 2.0, 3.0, 4.0}));
  };
  return {{"Canny after Gaussian", "OpenCV", {}, blurs(), canny_finders()},
          {"Canny after median", "OpenCV", {}, fronts(views, median_filters()), canny_finders()},
          {"Canny after NL-means", "OpenCV", {}, fronts(views, nlm_filters()), canny_finders()},
          {"Edge Drawing", "OpenCV", {}, blurs(), edge_drawing_finders()},
          {"EDPF", "OpenCV", {}, blurs(), one_finder(opencv_edpf)},
          {"LSD", "OpenCV", {}, blurs(), one_finder(opencv_lsd)}};
}

// On counts, behind a Gaussian; thresholds of the gradient in sigmas a pixel.
Competitor canny_of_counts(double sigma) {
  Competitor canny{"Canny of counts", "OpenCV", {}, {}, {}};
  for (const double blur_px : {1.0, 1.5, 2.0, 3.0}) {
    for (const double high : {0.05, 0.08, 0.12, 0.18, 0.25, 0.35, 0.5, 0.7}) {
      canny.wholes.push_back({fmt::format("Gaussian {} px high {} sigma", blur_px, high),
                              [=](const Frame& frame, Map map) {
                                opencv_canny_of_counts(counts_of(frame), blur_px, high * sigma,
                                                       map);
                              }});
    }
  }
  return canny;
}
#endif

// The presets and the peers, with these views.
std::vector<Competitor> competitors(const std::vector<View>& views) {
  std::vector<Competitor> all;
  all.reserve(16);
  for (const auto& preset : kPresets) {
    all.push_back(thermedge_competitor("thermedge " + std::string(preset.name),
                                       DetectorOptions(preset.value)));
  }
#ifdef THERMEDGE_BENCH_OPENCV
  for (Competitor& peer : opencv_competitors(views)) {
    all.push_back(std::move(peer));
  }
#endif
  for (const ClassicalName& method : kClassicalMethods) {
    Competitor competitor{display_name(method), "classical", {}, {}, {}};
    for (const View& view : views) {
      const std::string prefix = view.name.empty() ? "" : view.name + " ";
      competitor.fronts.push_back({prefix + "none", view.run});
      competitor.fronts.push_back(
          thermedge_denoiser(prefix + "Gaussian 5x5", DenoiseMethod::kGaussian, view));
    }
    competitor.finders = classical_finders(method.method);
    all.push_back(std::move(competitor));
  }
  return all;
}

}  // namespace

std::string Competitor::setting_name(std::size_t setting) const {
  if (!wholes.empty()) {
    return wholes[setting].name;
  }
  return fronts[setting / finders.size()].name + " " + finders[setting % finders.size()].name;
}

void Competitor::run(std::size_t setting, const Frame& frame, ImageView<std::uint8_t> map) const {
  if (!wholes.empty()) {
    wholes[setting].run(frame, map);
    return;
  }
  const Counts counts = counts_of(frame);
  Image<std::uint8_t> levels(counts.width(), counts.height());
  fronts[setting / finders.size()].run(counts, levels);
  finders[setting % finders.size()].run(levels, map);
}

WholeDetector thermedge_detector(const DetectorOptions& options) {
  DetectorOptions on_one_thread = options;
  on_one_thread.threads = 1;
  const auto detector = std::make_shared<Detector>(value_or_exit(Detector::create(on_one_thread)));
  return [detector](const Frame& frame, Map map) {
    draw_mask(value_or_exit(detector->detect(frame)).edges, map);
  };
}

Competitor thermedge_competitor(std::string name, const DetectorOptions& options) {
  return {std::move(name), "thermedge", {{"defaults", thermedge_detector(options)}}, {}, {}};
}

std::vector<Competitor> all_competitors() { return competitors({algorithm_1()}); }

std::vector<Competitor> competitors_in_noise(double sigma_counts) {
  std::vector<Competitor> all = competitors({view_in_noise(sigma_counts), stretched_view()});
#ifdef THERMEDGE_BENCH_OPENCV
  const auto first_peer = std::find_if(
      all.begin(), all.end(), [](const Competitor& one) { return one.family != "thermedge"; });
  all.insert(first_peer, canny_of_counts(sigma_counts));
#endif
  return all;
}

std::vector<FrontEnd> denoising_fronts() {
  std::vector<FrontEnd> fronts;
  fronts.push_back(front_without_filter());
  fronts.push_back(thermedge_denoiser("Gaussian", DenoiseMethod::kGaussian, algorithm_1()));
#ifdef THERMEDGE_BENCH_OPENCV
  fronts.push_back(
      front(algorithm_1(), {"median", [](Levels in, Map out) { opencv_median(in, 5, out); }}));
  fronts.push_back({"bilateral", [](Counts counts, Map levels) {
                      Image<std::uint8_t> plain(counts.width(), counts.height());
                      value_or_exit(scale_to_8bit(counts, kScale, plain));
                      const double sigma =
                          NoiseEstimator().measure(counts).sigma_counts * kScale.gain;
                      opencv_bilateral(plain, 3 * sigma, 2, levels);
                    }});
#endif
  fronts.push_back(thermedge_denoiser("NL-means", DenoiseMethod::kNlm, algorithm_1()));
  fronts.push_back(thermedge_denoiser("BM3D", DenoiseMethod::kBm3d, algorithm_1()));
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
  return {
      {"OpenCV Canny",
       "OpenCV",
       {},
       fronts({algorithm_1()}, gaussian_filters({1.5, 2.0, 3.0, 4.0})),
       cannies},
      {"OpenCV EDPF",
       "OpenCV",
       {},
       fronts({algorithm_1()}, gaussian_filters({0.7, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0})),
       one_finder(opencv_edpf)}};
#else
  return {};
#endif
}

}  // namespace thermedge::bench
