#include "thermedge/figures/comparison_sheet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <new>
#include <utility>

#include "denoiser_names.hpp"
#include "frame_panels.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge::figures {
namespace {

constexpr int kColumns = 4;
constexpr int kRuns = 5;

// What the classical detectors run on, and its unit.
struct ClassicalInput {
  Image<float> picture;
  double units_per_count = 1;
  double shared_ms = 0;  // that thermedge took to make the picture
};

double median(std::array<double, kRuns> values) {
  std::nth_element(values.begin(), values.begin() + kRuns / 2, values.end());
  return values[kRuns / 2];
}

// Median time of `work`, which is run once more before, so that it has its memory. ms.
Result<double> timed(const std::function<Status()>& work) {
  if (Status status = work(); !status) {
    return tl::unexpected(status.error());
  }
  std::array<double, kRuns> ms{};
  for (double& run : ms) {
    const auto start = std::chrono::steady_clock::now();
    if (Status status = work(); !status) {
      return tl::unexpected(status.error());
    }
    run =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  return median(ms);
}

void count(ComparedMap& map) {
  const MapCount found = count_fragments(map.edges.view());
  map.edge_pixels = found.edge_pixels;
  map.fragments = found.fragments;
}

double fragments_per_1000(const ComparedMap& map) {
  return map.edge_pixels > 0
             ? 1000.0 * static_cast<double>(map.fragments) / static_cast<double>(map.edge_pixels)
             : 0;
}

Panel map_panel(const ComparedMap& map) {
  return {.title = map.display,
          .note = fmt::format("{} edge pixels, {} fragments, {:.1f} ms", map.edge_pixels,
                              map.fragments, map.ms),
          .aspect = static_cast<double>(map.edges.height()) / map.edges.width(),
          .draw = map_picture(map.edges.view())};
}

Panel table_panel(std::span<const ComparedMap> maps, double aspect) {
  std::vector<TableRow> rows = {{{"detector", "pixels", "fragments", "/1000 px", "ms"}, false}};
  for (const ComparedMap& map : maps) {
    rows.push_back(
        {{map.display, fmt::format("{}", map.edge_pixels), fmt::format("{}", map.fragments),
          fmt::format("{:.1f}", fragments_per_1000(map)), fmt::format("{:.1f}", map.ms)},
         &map == &maps.back()});
  }
  return {.title = "In numbers",
          .note =
              "Fragments: groups of touching edge pixels. Time: from the frame to the map, "
              "median of five runs on this machine.",
          .aspect = aspect,
          .bordered = false,
          .draw = [rows = std::move(rows)](Canvas& canvas, const Box& box) {
            draw_table(canvas, box, rows, 0.3);
          }};
}

Status check_thresholds(const CannyThresholds& thresholds) {
  for (const auto& threshold : {thresholds.high, thresholds.low}) {
    if (!(threshold.value >= 0 && threshold.value <= 1e6)) {
      return failure(ErrorCode::kInvalidArgument,
                     "Canny's thresholds should be 0 to 1e6 counts or sigma a pixel");
    }
  }
  if (thresholds.low.value > 0 && thresholds.high.value == 0) {
    return failure(ErrorCode::kInvalidArgument,
                   "Canny's low threshold needs the high one beside it");
  }
  if (thresholds.low.unit == thresholds.high.unit && thresholds.low.value > thresholds.high.value) {
    return failure(ErrorCode::kInvalidArgument,
                   "Canny's low threshold should not be above the high one");
  }
  return {};
}

}  // namespace

struct ComparisonSheet::Impl {
  explicit Impl(const ComparisonOptions& chosen, Detector made)
      : options(chosen),
        runner(make_runner(chosen.detector.threads)),
        detector(std::move(made)),
        denoiser(plain(chosen.classical_denoiser.value_or(DenoiseMethod::kNone))) {}

  static DenoiseOptions plain(DenoiseMethod method) {
    DenoiseOptions options;
    options.method = method;
    return options;
  }

  [[nodiscard]] ClassicalInput input_of(int bits, Intermediates& steps) const;
  [[nodiscard]] Result<ClassicalOptions> classical_options(double units_per_count) const;
  Result<ComparedMap> run_classical(const ClassicalName& method, const ClassicalInput& input,
                                    ClassicalDetector& classical);
  Result<ComparedMap> run_thermedge(const Frame& frame);
  Result<Comparison> draw(ImageView<const std::uint16_t> frame, int bits, const std::string& source,
                          ImageView<const std::uint8_t> valid);
  [[nodiscard]] Figure sheet(ImageView<const std::uint16_t> frame,
                             std::span<const ComparedMap> maps, const std::string& source) const;
  [[nodiscard]] std::string what_ran() const;
  [[nodiscard]] std::string log_text() const;
  [[nodiscard]] std::string canny_text() const;

  ComparisonOptions options;
  std::unique_ptr<ParallelRunner> runner;
  Detector detector;
  Detection detection;
  Denoiser denoiser;
};

// Of the last run of thermedge, whose times `detection` holds.
ClassicalInput ComparisonSheet::Impl::input_of(int bits, Intermediates& steps) const {
  const PaperOptions* paper = options.detector.paper();
  const double gain =
      bits == 8 ? 1 : (paper != nullptr ? paper->grey_scale : GreyScaleOptions{}).gain;
  ClassicalInput input;
  if (options.classical_denoiser) {
    input.picture.resize(steps.levels.width(), steps.levels.height());
    copy_pixels(steps.levels.view(), input.picture.view());
    input.units_per_count = gain;
    return input;
  }
  input.picture = std::move(steps.denoised_values);
  input.units_per_count = paper != nullptr ? gain : 1;
  for (const StageTime& time : detection.times) {
    input.shared_ms += time.ms;
    if (time.stage == "denoise") {
      break;
    }
  }
  return input;
}

// Canny's magnitude is that of the Sobel kernels, 8 times the gradient.
Result<ClassicalOptions> ComparisonSheet::Impl::classical_options(double units_per_count) const {
  constexpr double kSobelGain = 8;
  const auto [high, low] = options.canny_thresholds;
  ClassicalOptions made = options.classical;
  if (high.value == 0) {
    return made;
  }
  const double sigma = detection.sigma_counts;
  const auto in_counts = [&](const Quantity<GradientUnit>& threshold) {
    return threshold.value * (threshold.unit == GradientUnit::kSigma ? sigma : 1);
  };
  if (in_counts(high) == 0 || (low.value > 0 && in_counts(low) == 0)) {
    return failure(ErrorCode::kInvalidArgument,
                   "the frame has no measurable noise; give Canny's thresholds in counts");
  }
  made.canny.high_threshold = kSobelGain * units_per_count * in_counts(high);
  if (low.value > 0) {
    made.canny.low_over_high = in_counts(low) / in_counts(high);
  }
  if (made.canny.low_over_high > 1) {
    return failure(ErrorCode::kInvalidArgument,
                   "Canny's low threshold should not be above the high one");
  }
  return made;
}

Result<ComparedMap> ComparisonSheet::Impl::run_classical(const ClassicalName& method,
                                                         const ClassicalInput& input,
                                                         ClassicalDetector& classical) {
  ComparedMap map;
  map.name = method.name;
  map.display = method.display;
  const ImageView<const float> picture = input.picture.view();
  map.edges.resize(picture.width(), picture.height());
  Image<float> denoised(picture.width(), picture.height());
  const double sigma = detection.sigma_counts * input.units_per_count;
  const auto work = [&]() -> Status {
    if (!options.classical_denoiser) {
      return classical.run(picture, method.method, map.edges, *runner);
    }
    return denoiser.run_measured(picture, sigma, denoised, *runner).and_then([&] {
      return classical.run(denoised, method.method, map.edges, *runner);
    });
  };
  return timed(work).map([&](double ms) {
    map.ms = ms + input.shared_ms;
    count(map);
    return std::move(map);
  });
}

Result<ComparedMap> ComparisonSheet::Impl::run_thermedge(const Frame& frame) {
  ComparedMap map;
  map.name = "thermedge";
  map.display = fmt::format("thermedge ({})", preset_name(options.detector.preset()));
  map.edges.resize(frame.width(), frame.height());
  return timed([&] {
           return detector.detect(frame, detection).map([&] {
             draw_mask(detection.edges, map.edges);
           });
         })
      .map([&](double ms) {
        map.ms = ms;
        count(map);
        return std::move(map);
      });
}

Result<Comparison> ComparisonSheet::Impl::draw(ImageView<const std::uint16_t> frame, int bits,
                                               const std::string& source,
                                               ImageView<const std::uint8_t> valid) {
  Frame given(frame, bits);
  given.valid = valid;
  Intermediates steps;
  if (Status status = detector.detect(given, detection, {&steps, {}}); !status) {
    return tl::unexpected(status.error());
  }
  auto thermedge_map = run_thermedge(given);
  if (!thermedge_map) {
    return tl::unexpected(thermedge_map.error());
  }
  const ClassicalInput input = input_of(bits, steps);
  const auto chosen = classical_options(input.units_per_count);
  if (!chosen) {
    return tl::unexpected(chosen.error());
  }
  ClassicalDetector classical(*chosen);
  std::vector<ComparedMap> maps;
  for (const ClassicalName& method : kClassicalMethods) {
    auto map = run_classical(method, input, classical);
    if (!map) {
      return tl::unexpected(map.error());
    }
    maps.push_back(std::move(*map));
  }
  maps.push_back(std::move(*thermedge_map));
  Figure drawn = sheet(frame, maps, source);
  return Comparison{std::move(drawn), std::move(maps)};
}

// The frame and the numbers to the left of the six maps.
Figure ComparisonSheet::Impl::sheet(ImageView<const std::uint16_t> frame,
                                    std::span<const ComparedMap> maps,
                                    const std::string& source) const {
  const double aspect = static_cast<double>(detection.height) / detection.width;
  std::vector<Panel> panels = {
      {.title = "Frame",
       .note = fmt::format("{} x {} pixels, noise sigma {:.1f} counts", detection.width,
                           detection.height, detection.corrections.noise.sigma_counts),
       .aspect = aspect,
       .draw = frame_picture(frame)}};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (i == 3) {
      panels.push_back(table_panel(maps, aspect));
    }
    panels.push_back(map_panel(maps[i]));
  }
  const SheetText text = {
      .title = "Edge detectors compared",
      .subtitle = source + "; " + what_ran(),
      .footer =
          "After figures 14 and 15 of Vu Hoang Minh et al. 2017. The classical detectors are "
          "those of MATLAB's edge with its automatic thresholds" +
          log_text() + canny_text() + "."};
  return make_sheet(text, panels, kColumns, panel_width_for(detection.width, options.panel_width));
}

std::string ComparisonSheet::Impl::what_ran() const {
  const DenoiseMethod own = options.detector.denoise.method;
  if (!options.classical_denoiser) {
    return own == DenoiseMethod::kNone
               ? std::string("all detectors run on the same picture, not denoised")
               : fmt::format("all detectors run on the same picture, denoised by {}",
                             display_name(own));
  }
  return fmt::format("the classical detectors run on its 8-bit view{}",
                     *options.classical_denoiser == DenoiseMethod::kNone
                         ? std::string(", not denoised")
                         : fmt::format(" after {}", display_name(*options.classical_denoiser)));
}

std::string ComparisonSheet::Impl::log_text() const {
  const int side = options.classical.log_kernel_px;
  return side == 0 ? "" : fmt::format("; LoG: kernel of {0}x{0} px", side);
}

// What of Canny is not as MATLAB has it.
std::string ComparisonSheet::Impl::canny_text() const {
  const auto text = [](const Quantity<GradientUnit>& threshold) {
    return fmt::format("{:g} {}", threshold.value,
                       threshold.unit == GradientUnit::kSigma ? "sigma a pixel" : "counts a pixel");
  };
  const auto [high, low] = options.canny_thresholds;
  std::string changes;
  if (options.classical.canny_sigma_px != ClassicalOptions{}.canny_sigma_px) {
    changes = fmt::format(", Gaussian {:g} px", options.classical.canny_sigma_px);
  }
  if (high.value > 0) {
    changes += ", high threshold " + text(high);
  }
  if (low.value > 0) {
    changes += ", low threshold " + text(low);
  }
  return changes.empty() ? "" : "; Canny:" + changes.substr(1);
}

Result<ComparisonSheet> ComparisonSheet::create(const ComparisonOptions& options) {
  return check_options(options.classical)
      .and_then([&] { return check_thresholds(options.canny_thresholds); })
      .and_then([&] { return Detector::create(options.detector); })
      .map([&](Detector&& detector) {
        return ComparisonSheet(std::make_unique<Impl>(options, std::move(detector)));
      });
}

ComparisonSheet::ComparisonSheet(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ComparisonSheet::ComparisonSheet(ComparisonSheet&&) noexcept = default;
ComparisonSheet& ComparisonSheet::operator=(ComparisonSheet&&) noexcept = default;
ComparisonSheet::~ComparisonSheet() = default;

Result<Comparison> ComparisonSheet::draw(ImageView<const std::uint16_t> frame, int bits,
                                         const std::string& source,
                                         ImageView<const std::uint8_t> valid) {
  try {
    return impl_->draw(frame, bits, source, valid);
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, "comparison: out of memory");
  }
}

}  // namespace thermedge::figures
