#include "thermedge/detector.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "thermedge/stages/contrast.hpp"
#include "thermedge/stages/corners.hpp"
#include "thermedge/stages/corners_paper.hpp"
#include "thermedge/stages/gap_closing.hpp"
#include "thermedge/stages/preprocessor.hpp"
#include "thermedge/stages/subpixel.hpp"

namespace thermedge {
namespace {

// What the removal of stripes leaves of them, in units of the noise (docs/tuning.md), and as a
// share of strong ones: beside walls they cannot be told from the scene.
constexpr double kStripesLeft = 0.08;
constexpr double kShareLeft = 1.0 / 6;
// Noise below this share of the frame's range is none.
constexpr double kNoNoise = 0.002;
// Without noise a slope comes as terraces of one count, which are no edges: so much is added to the
// noise then.
constexpr double kRoundingCounts = 10;
// Noise of such shares of the range is next to no burden, and a full one. From the first on a
// Gaussian blurs as much as its options say.
constexpr double kCleanNoise = 0.036;
constexpr double kFullNoise = 0.05;

using Clock = std::chrono::steady_clock;

// Adds the time from its making to its end to a stage.
class Stopwatch {
 public:
  explicit Stopwatch(double& stage_ms) : stage_ms_(stage_ms), start_(Clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() {
    stage_ms_ += std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  double& stage_ms_;
  Clock::time_point start_;
};

double root_mean_square(std::span<const float> values) {
  double sum = 0;
  for (const float value : values) {
    sum += static_cast<double>(value) * value;
  }
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

// Standard deviation of what is left of removed stripes, in units of the noise.
double stripes_left(const StripeOffsets& removed, double sigma) {
  const double strength =
      std::max(root_mean_square(removed.columns), root_mean_square(removed.rows)) / sigma;
  constexpr double kRounding = 0.2887;  // counts: 1 / sqrt(12), corrected counts are whole ones
  return strength > 0 ? std::hypot(std::max(kStripesLeft, kShareLeft * strength), kRounding / sigma)
                      : 0;
}

std::uint8_t to_level(float value) {
  return static_cast<std::uint8_t>(std::min(std::max(value, 0.0F), 255.0F) + 0.5F);
}

}  // namespace

double StageTimes::total() const {
  double sum = 0;
  for (const Stage& stage : kStages) {
    sum += this->*stage.ms;
  }
  return sum;
}

struct Detector::Impl {
  explicit Impl(const DetectorOptions& chosen)
      : options(chosen),
        runner(make_runner(chosen.threads)),
        preprocessor(chosen.nuc),
        denoiser(chosen.denoise),
        canny(chosen.canny),
        oriented(chosen.oriented),
        tracer(chosen.contours),
        graph(chosen.graph),
        gap_closer(chosen.gap_closing),
        paper_corner_finder(chosen.paper_corners),
        corner_finder(chosen.corners),
        linker(chosen.linking),
        scorer(chosen.scoring),
        selector(chosen.selection),
        budgets({chosen.selection.keep_edges, chosen.selection.max_edgels}) {}

  Status detect(ImageView<const std::uint16_t> frame, int bits);
  Status trace(ImageView<const std::uint8_t> edge_map);

  Status detect_oriented(int bits);
  Status bridge();
  double range_of_counts();
  Status denoise_counts(int bits, double burden);
  void show_denoised();

  void begin(int width, int height);
  void correct(ImageView<const std::uint16_t> frame);
  Status scale(int bits);
  Status denoise(int bits);
  Status find_edge_pixels();
  Status connect();
  Status find_corners();

  DetectorOptions options;
  std::unique_ptr<ParallelRunner> runner;
  NoiseEstimator noise_estimator;
  Preprocessor preprocessor;
  Denoiser denoiser;
  Canny canny;
  OrientedFilterBank oriented;
  ContourTracer tracer;
  GraphTracer graph;
  GapCloser gap_closer;
  PaperCornerFinder paper_corner_finder;
  CornerFinder corner_finder;
  Linker linker;
  Scorer scorer;
  EdgeSelector selector;
  EdgeSelector budgets;  // the same without tests, which need a frame

  Image<std::uint8_t> levels, denoised, edge_map;
  Image<float> working;
  Image<std::uint16_t> rounded;         // denoised counts
  OrientedFilterResult oriented_found;  // views of what `oriented` holds
  std::vector<std::uint16_t> sample;    // of the counts
  ContourSet contours;
  LinkedContours traced;               // by the graph, before gap_closing
  std::vector<std::uint8_t> eligible;  // of its curves: to be bridged
  LinkedContours linked;
  CornerSet corners;
  Detection result;
};

// The paper's Algorithm 6, step by step.
Status Detector::Impl::detect(ImageView<const std::uint16_t> frame, int bits) {
  begin(frame.width(), frame.height());
  correct(frame);
  if (options.edges == EdgeMethod::kOriented) {
    return detect_oriented(bits);
  }
  return scale(bits)
      .and_then([&] { return denoise(bits); })
      .and_then([&] { return find_edge_pixels(); })
      .and_then([&] { return connect(); })
      .and_then([&] {
        const Stopwatch watch(result.ms.measure);
        measure_edges(result.corrected, result.noise.sigma_counts, result.edges);
        return selector.run(result.edges);
      });
}

// On counts, in units of the noise.
Status Detector::Impl::detect_oriented(int bits) {
  const double sigma =
      options.denoise.sigma_counts > 0 ? options.denoise.sigma_counts : result.noise.sigma_counts;
  const double range = range_of_counts();
  result.sigma_counts = sigma > kNoNoise * range ? sigma : 0;
  const double rounding = result.sigma_counts > 0 ? 0 : kRoundingCounts;
  const double unit = std::hypot(sigma, options.oriented.noise_floor * range, rounding);
  result.range_counts = range;
  result.unit_counts = unit;
  const double noisiness =
      std::clamp((sigma / range - kCleanNoise) / (kFullNoise - kCleanNoise), 0.0, 1.0);
  return scale(bits)
      .and_then([&] {
        const bool blurs = options.denoise.method == DenoiseMethod::kGaussian;
        return denoise_counts(bits, blurs ? std::min(sigma / range / kCleanNoise, 1.0) : noisiness);
      })
      .and_then([&] {
        const Stopwatch watch(result.ms.canny);
        return oriented.run(working, unit, noisiness, *runner)
            .map([&](const OrientedFilterResult& edges) {
              oriented_found = edges;
              result.edge_map = edges.edges;
              result.kernel_px = edges.kernel;
              result.threshold_low = options.oriented.low;
              result.threshold_high = options.oriented.high;
            });
      })
      .and_then([&] {
        const Stopwatch watch(result.ms.contours);
        return graph.run(oriented_found.edges, oriented_found.response, traced);
      })
      .and_then([&] {
        const Stopwatch watch(result.ms.linking);
        return bridge();
      })
      .and_then([&] {
        const Stopwatch watch(result.ms.corners);
        return find_corners();
      })
      .and_then([&] {
        const Stopwatch watch(result.ms.scoring);
        return scorer.run(linked, corners, oriented_found.suppressed_response, result.edges);
      })
      .and_then([&] {
        const Stopwatch watch(result.ms.measure);
        measure_edges(result.corrected, result.sigma_counts, oriented_found.direction,
                      {stripes_left(*result.stripes, sigma)}, result.edges);
        refine_positions(oriented_found.response, oriented_found.kernel, sigma / unit,
                         result.edges);
        return selector.run(result.edges).map([&] {
          selector.keep_junctions(result.width, result.height, result.edges);
        });
      });
}

// What is too weak to be kept is not worth a bridge.
Status Detector::Impl::bridge() {
  eligible.reserve(traced.contours.items.capacity());
  eligible.clear();
  for (const Contour& contour : traced.contours.items) {
    const double score =
        saliency(traced.contours.pixels(contour), oriented_found.suppressed_response);
    eligible.push_back(score >= options.selection.min_score ? 1 : 0);
  }
  return gap_closer.run(traced, working, eligible, linked);
}

// From the 0.1st to the 99.9th percentile; every 16th pixel tells, the same ones of a mirrored
// frame.
double Detector::Impl::range_of_counts() {
  constexpr int kStep = 4;
  constexpr double kTail = 0.001;
  sample.clear();
  const auto is_sampled = [](int i, int size) { return std::min(i, size - 1 - i) % kStep == 0; };
  for (int y = 0; y < result.height; ++y) {
    if (!is_sampled(y, result.height)) {
      continue;
    }
    for (int x = 0; x < result.width; ++x) {
      if (is_sampled(x, result.width)) {
        sample.push_back(result.corrected(x, y));
      }
    }
  }
  const auto quantile = [&](double share) {
    const auto at = sample.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
    std::nth_element(sample.begin(), at, sample.end());
    return static_cast<double>(*at);
  };
  constexpr double kLeast = 1;  // of a frame without any contrast
  return std::max(quantile(1 - kTail) - quantile(kTail), kLeast);
}

Status Detector::Impl::denoise_counts(int bits, double burden) {
  const Stopwatch watch(result.ms.denoise);
  working.resize(result.width, result.height);
  copy_pixels(result.corrected, working.view());
  // Where noise is next to no burden, a Gaussian only blurs; and the bilateral that BM3D leaves is
  // a matter of strong noise: taking it off steepens slopes.
  if (Status status = denoiser.run_measured(working, result.sigma_counts, working, *runner, burden);
      !status) {
    return status;
  }
  if (bits == 8) {
    show_denoised();
    return {};
  }
  denoised.resize(result.width, result.height);
  result.denoised = denoised;
  rounded.resize(result.width, result.height);
  round_to_counts(working, rounded);
  return scale_to_8bit(rounded, options.scale, denoised);
}

// What is in grey levels already, rounded.
void Detector::Impl::show_denoised() {
  denoised.resize(result.width, result.height);
  for (int y = 0; y < result.height; ++y) {
    std::transform(working.row(y), working.row(y) + result.width, denoised.row(y), to_level);
  }
  result.denoised = denoised;
}

Status Detector::Impl::trace(ImageView<const std::uint8_t> map) {
  begin(map.width(), map.height());
  edge_map.resize(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    std::transform(map.row(y), map.row(y) + map.width(), edge_map.row(y),
                   [](std::uint8_t value) { return value != 0 ? std::uint8_t{255} : value; });
  }
  result.edge_map = edge_map;
  return connect().and_then([&] {
    set_normals_from_shape(result.edges);
    for (Edge& edge : result.edges.edges) {
      edge.contrast_counts = edge.z = edge.log10_nfa = std::numeric_limits<double>::quiet_NaN();
    }
    return budgets.run(result.edges);
  });
}

void Detector::Impl::begin(int width, int height) {
  result.width = width;
  result.height = height;
  result.noise = {};
  result.sigma_counts = 0;
  result.ms = {};
  result.bad_pixels = {};
  result.stripes = nullptr;
  result.corrected = {};
  result.levels = {};
  result.denoised = {};
  result.edge_map = {};
  result.range_counts = 0;
  result.unit_counts = 0;
  result.kernel_px = {0, 0};
  result.threshold_low = 0;
  result.threshold_high = 0;
  result.contours = options.edges == EdgeMethod::kOriented ? &traced.contours : &contours;
  result.linked = &linked;
}

// Noise, dead pixels, stripes (before the paper's first step).
void Detector::Impl::correct(ImageView<const std::uint16_t> frame) {
  {
    const Stopwatch watch(result.ms.noise);
    result.noise = noise_estimator.measure(frame);
  }
  const Stopwatch watch(result.ms.nuc);
  result.corrected = preprocessor.run(frame, result.noise.sigma_counts, *runner);
  result.bad_pixels = preprocessor.bad_pixels();
  result.stripes = &preprocessor.stripes();
}

// Algorithm 1. 8-bit pictures are grey levels already.
Status Detector::Impl::scale(int bits) {
  const Stopwatch watch(result.ms.scale);
  levels.resize(result.width, result.height);
  result.levels = levels;
  if (bits == 8) {
    copy_pixels(result.corrected, levels.view());
    return {};
  }
  return scale_to_8bit(result.corrected, options.scale, levels);
}

// Section 3: the noise in grey levels is the noise in counts times the gain.
Status Detector::Impl::denoise(int bits) {
  const Stopwatch watch(result.ms.denoise);
  result.sigma_counts =
      options.denoise.sigma_counts > 0 ? options.denoise.sigma_counts : result.noise.sigma_counts;
  const double levels_per_count = bits == 8 ? 1.0 : options.scale.gain;
  working.resize(result.width, result.height);
  copy_pixels(result.levels, working.view());
  const double sigma_levels = result.sigma_counts * levels_per_count;
  return denoiser.run_measured(working, sigma_levels, working, *runner).map([&] {
    show_denoised();
  });
}

// Algorithm 2.
Status Detector::Impl::find_edge_pixels() {
  const Stopwatch watch(result.ms.canny);
  return canny.run(working, *runner).map([&](const CannyResult& found) {
    result.edge_map = found.edges;
    result.threshold_low = found.low;
    result.threshold_high = found.high;
  });
}

// Algorithms 3 to 6: contours, links, corners, scores; with oriented kernels, from the map alone.
// Corners are found on the linked curves; those of the curves before linking would be thrown away
// unused.
Status Detector::Impl::connect() {
  const auto timed = [](double& stage_ms, auto&& stage) {
    const Stopwatch watch(stage_ms);
    return stage();
  };
  StageTimes& ms = result.ms;
  const auto walk = [&] {
    return timed(ms.contours, [&] { return tracer.run(result.edge_map, contours); }).and_then([&] {
      return timed(ms.linking,
                   [&] { return linker.run(contours, result.width, result.height, linked); });
    });
  };
  const auto follow_graph = [&] {
    working.resize(result.width, result.height);
    fill_pixels(working.view(), 1.0F);  // all pixels are equally strong
    return timed(ms.contours, [&] { return graph.run(result.edge_map, working, traced); })
        .and_then([&] {
          eligible.assign(traced.contours.items.size(), 0);  // no frame tells what gaps hold
          return gap_closer.run(traced, working, eligible, linked);
        });
  };
  return (options.edges == EdgeMethod::kOriented ? follow_graph() : walk())
      .and_then([&] { return timed(ms.corners, [&] { return find_corners(); }); })
      .and_then([&] {
        return timed(ms.scoring, [&] {
          return scorer.run(linked, corners, result.width, result.height, result.edges);
        });
      });
}

Status Detector::Impl::find_corners() {
  if (options.edges == EdgeMethod::kOriented) {
    return corner_finder.run(linked.contours, corners);
  }
  return paper_corner_finder.run(linked.contours, corners).map([&] {
    if (options.linking.gap_px > 0) {
      merge_seam_corners(linked.contours, options.paper_corners.end_distance_px, corners);
    }
  });
}

Result<Detector> Detector::create(const DetectorOptions& options) {
  if (Status status = check_options(options); !status) {
    return tl::unexpected(status.error());
  }
  try {
    return Detector(std::make_unique<Impl>(options));
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, "detector: out of memory");
  }
}

Detector::Detector(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;
Detector::~Detector() = default;

const DetectorOptions& Detector::options() const { return impl_->options; }

namespace {

template <class Run>
Result<const Detection*> guarded(const Detection& result, bool empty, Run&& run) {
  if (empty) {
    return failure(ErrorCode::kInvalidArgument, "frame: it has no pixels");
  }
  try {
    return run().map([&] { return &result; });
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, "frame of " + std::to_string(result.width) + "x" +
                                                std::to_string(result.height) +
                                                " pixels: out of memory");
  }
}

}  // namespace

Result<const Detection*> Detector::detect(ImageView<const std::uint16_t> frame, int bits) {
  return guarded(impl_->result, frame.empty(), [&] { return impl_->detect(frame, bits); });
}

Result<const Detection*> Detector::trace(ImageView<const std::uint8_t> edge_map) {
  return guarded(impl_->result, edge_map.empty(), [&] { return impl_->trace(edge_map); });
}

}  // namespace thermedge
