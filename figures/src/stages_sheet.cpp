#include "thermedge/figures/stages_sheet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "denoiser_names.hpp"
#include "frame_panels.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/io/overlay.hpp"
#include "thermedge/radiometry/grey_scale.hpp"

namespace thermedge::figures {
namespace {

constexpr int kColumns = 4;

// The output of one denoiser.
struct Denoised {
  DenoiseMethod method;
  Image<std::uint8_t> levels;
  double ms = 0;
};

std::string plural(std::size_t count, std::string_view one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

double rms_difference(ImageView<const std::uint8_t> a, ImageView<const std::uint8_t> b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const double difference = a(x, y) - b(x, y);
      sum += difference * difference;
    }
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double share_of_level(ImageView<const std::uint8_t> levels, std::uint8_t level) {
  std::ptrdiff_t count = 0;
  for (int y = 0; y < levels.height(); ++y) {
    count += std::count(levels.row(y), levels.row(y) + levels.width(), level);
  }
  return static_cast<double>(count) / static_cast<double>(levels.size());
}

// Makes the panels of one frame. Holds references only.
class StagePanels {
 public:
  StagePanels(const DetectorOptions& options, const Detection& detection,
              const Intermediates& steps, std::span<const Denoised> denoised,
              ImageView<const std::uint8_t> mask, int bits)
      : options_(options),
        found_(detection),
        steps_(steps),
        denoised_(denoised),
        mask_(mask),
        bits_(bits) {
    if (const PaperOptions* paper = options.paper()) {
      gain_ = paper->grey_scale.gain;
    }
  }

  [[nodiscard]] std::vector<Panel> all() const {
    std::vector<Panel> panels = {frame(), levels()};
    for (const Denoised& picture : denoised_) {
      panels.push_back(denoised(picture));
    }
    for (Panel& panel : std::vector<Panel>{edge_pixels(), contours(), links(), corners(), scores(),
                                           ranks(), mask(), times()}) {
      panels.push_back(std::move(panel));
    }
    return panels;
  }

 private:
  [[nodiscard]] Panel panel(std::string title, std::string note, Draw draw) const {
    return {.title = std::move(title),
            .note = std::move(note),
            .aspect = static_cast<double>(found_.height) / found_.width,
            .draw = std::move(draw)};
  }

  // Lines and marks over the darkened frame.
  [[nodiscard]] Panel drawn_over(std::string title, std::string note,
                                 std::function<void(Canvas&)> lines) const {
    return panel(std::move(title), std::move(note),
                 [ground = dimmed_frame(steps_.corrected.view()), lines = std::move(lines),
                  width = found_.width, height = found_.height](Canvas& canvas, const Box& box) {
                   ground(canvas, box);
                   canvas.inside_frame(box, width, height, [&] { lines(canvas); });
                 });
  }

  [[nodiscard]] Panel frame() const {
    const CountRange range = count_range(steps_.corrected.view());
    std::string note = fmt::format(
        "{} to {} counts, noise sigma {:.1f} counts; shown from the "
        "0.5th to the 99.5th percentile.",
        range.min, range.max, found_.corrections.noise.sigma_counts);
    if (!found_.corrections.bad_pixels.empty()) {
      note +=
          fmt::format(" {} replaced.", plural(found_.corrections.bad_pixels.size(), "bad pixel"));
    }
    const InvalidPixels& invalid = found_.corrections.invalid;
    if (invalid.given + invalid.found > 0) {
      note += fmt::format(" {} no measurement.",
                          invalid.given + invalid.found == 1
                              ? std::string("1 pixel is")
                              : fmt::format("{} pixels are", invalid.given + invalid.found));
    }
    return panel("Frame", std::move(note), frame_picture(steps_.corrected.view()));
  }

  [[nodiscard]] Panel levels() const {
    std::string note =
        bits_ == 8 ? std::string("The input has 8 bits: taken as it is.")
                   : fmt::format(
                         "{} levels a count around the median {}; clipped: {:.1f} % black, {:.1f} "
                         "% white.",
                         gain_, median_counts(steps_.corrected.view()),
                         100 * share_of_level(steps_.levels.view(), 0),
                         100 * share_of_level(steps_.levels.view(), 255));
    return panel("8-bit view (Algorithm 1)", std::move(note), levels_picture(steps_.levels.view()));
  }

  [[nodiscard]] Panel denoised(const Denoised& picture) const {
    const double levels_per_count = bits_ == 8 ? 1 : gain_;
    const bool used = picture.method == options_.denoise.method;
    std::string note =
        fmt::format("took out {:.1f} counts (rms) in {:.1f} ms{}",
                    rms_difference(picture.levels.view(), steps_.levels.view()) / levels_per_count,
                    picture.ms, used ? "; the steps below go on from this one." : ".");
    return panel(fmt::format("Denoised: {}", display_name(picture.method)), std::move(note),
                 levels_picture(picture.levels.view()));
  }

  [[nodiscard]] Panel edge_pixels() const {
    const double share = 1 - share_of_level(steps_.edge_map.view(), 0);
    const bool oriented = options_.robust() != nullptr;
    const std::string thresholds =
        oriented
            ? fmt::format(
                  "suppressed_response above {:.2f}, connected down to {:.2f}, in units of the "
                  "noise",
                  found_.threshold_high, found_.threshold_low)
            : fmt::format("Sobel magnitude above {:.1f}, connected down to {:.1f} levels",
                          found_.threshold_high, found_.threshold_low);
    return panel(
        oriented ? "Edge pixels (oriented filter)" : "Edge pixels (Canny)",
        fmt::format("{:.0f} pixels, {:.1f} % of the frame; {}.",
                    share * static_cast<double>(steps_.edge_map.size()), 100 * share, thresholds),
        map_picture(steps_.edge_map.view()));
  }

  [[nodiscard]] Panel contours() const {
    const ContourSet& set = steps_.contours;
    const auto closed = std::count_if(set.items.begin(), set.items.end(),
                                      [](const Contour& contour) { return contour.closed; });
    return drawn_over("Contours",
                      fmt::format("{}, {} closed, {} pixels; a new colour for each.",
                                  plural(set.items.size(), "contour"), closed, set.points.size()),
                      [&set](Canvas& canvas) { draw_contours(canvas, set); });
  }

  [[nodiscard]] Panel links() const {
    const LinkedContours& linked = steps_.linked;
    const bool from_graph = options_.robust() != nullptr;
    Panel made = drawn_over(
        "Links",
        from_graph ? std::string("ends of contours that meet the middle of another one.")
                   : fmt::format("gaps under {} px: {} contours became {}.",
                                 options_.paper()->linking.gap_px, steps_.contours.items.size(),
                                 linked.contours.items.size()),
        [&linked](Canvas& canvas) {
          draw_contours(canvas, linked.contours, {150, 154, 160});
          draw_links(canvas, linked.links);
        });
    made.legend.assign(link_marks().begin(), link_marks().end());
    for (std::size_t i = 0; i < made.legend.size(); ++i) {
      const auto count = std::count_if(
          linked.links.begin(), linked.links.end(),
          [&](const Link& link) { return static_cast<std::size_t>(link.type) == i + 1; });
      made.legend[i].label += fmt::format(" {}", count);
    }
    return made;
  }

  [[nodiscard]] Panel corners() const {
    const EdgeSet& set = found_.edges;
    return drawn_over(
        "Corners",
        fmt::format("{} on {}, ends of open ones counted.", plural(set.corners.size(), "corner"),
                    plural(set.edges.size(), "edge")),
        [&set](Canvas& canvas) {
          draw_edges(canvas, set, set.edges, [](const Edge&) { return Rgb{86, 140, 190}; });
          draw_corners(canvas, set, {255, 214, 70});
        });
  }

  [[nodiscard]] Panel scores() const {
    return options_.robust() != nullptr ? statuses() : edge_scores();
  }

  // Whether options let edges have this status.
  [[nodiscard]] bool is_asked_for(EdgeStatus status) const {
    const SelectionOptions& selection = options_.selection;
    return status == EdgeStatus::kLowContrast ? selection.min_contrast.value > 0
           : status == EdgeStatus::kBeyondBudget
               ? selection.keep_edges > 0 || selection.max_edgels > 0
               : true;
  }

  // Why edges were kept or dropped.
  [[nodiscard]] Panel statuses() const {
    const EdgeSet& set = found_.edges;
    struct Kind {
      EdgeStatus status;
      Rgb colour;
      std::string_view label;
    };
    static const std::array<Kind, 5> kKinds = {
        Kind{EdgeStatus::kWeak, {96, 104, 116}, "weak"},
        Kind{EdgeStatus::kInsignificant, category_colour(3), "not significant"},
        Kind{EdgeStatus::kLowContrast, category_colour(5), "low contrast"},
        Kind{EdgeStatus::kBeyondBudget, category_colour(4), "beyond budget"},
        Kind{EdgeStatus::kKept, category_colour(1), "kept"}};
    const auto& selection = options_.selection;
    Panel made = drawn_over(
        "Status of each edge",
        fmt::format(
            "score (log of suppressed_response, and of length) from {:.2f}; on the raw frame, at "
            "most {:g} such edges expected of noise alone.",
            selection.min_score, selection.max_false_alarms),
        [&set](Canvas& canvas) {
          draw_edges(canvas, set, set.edges, [](const Edge& edge) {
            return std::find_if(kKinds.begin(), kKinds.end(),
                                [&](const Kind& kind) { return kind.status == edge.status; })
                ->colour;
          });
        });
    for (const Kind& kind : kKinds) {
      if (!is_asked_for(kind.status)) {
        continue;
      }
      const auto count = std::count_if(set.edges.begin(), set.edges.end(), [&](const Edge& edge) {
        return edge.status == kind.status;
      });
      made.legend.push_back({Mark::kDisc, kind.colour, fmt::format("{} {}", kind.label, count)});
    }
    return made;
  }

  [[nodiscard]] Panel edge_scores() const {
    const EdgeSet& set = found_.edges;
    if (set.edges.empty()) {
      return drawn_over("Edge score ES", "no edge.", [](Canvas&) {});
    }
    // ES spans decades; the colours are even steps of its logarithm between the deciles.
    std::vector<double> es;
    for (const Edge& edge : set.edges) {
      es.push_back(edge.es);
    }
    std::sort(es.begin(), es.end());
    const double low = std::max(es[es.size() / 10], 1e-6);
    const double high = std::max(es[es.size() - 1 - es.size() / 10], 2 * low);
    const auto share = [=](double value) {
      return std::log(std::max(value, 1e-9) / low) / std::log(high / low);
    };
    Panel made =
        drawn_over("Edge score ES",
                   fmt::format("median {:.3g}; small is smooth, long and connected (eq. 18).",
                               es[es.size() / 2]),
                   [&set, share](Canvas& canvas) {
                     draw_edges(canvas, set, set.edges,
                                [&](const Edge& edge) { return io::rank_colour(share(edge.es)); });
                   });
    made.colour_bars = {{io::rank_colour, fmt::format("{:.3g}", low), fmt::format("{:.3g}", high)}};
    return made;
  }

  [[nodiscard]] Panel ranks() const {
    const EdgeSet& set = found_.edges;
    const double last = std::max<double>(1, static_cast<double>(set.kept) - 1);
    Panel made = drawn_over(
        "Rank of the kept edges",
        fmt::format("the best {} of {}; the others are left out.", set.kept, set.edges.size()),
        [&set, last](Canvas& canvas) {
          draw_edges(canvas, set, set.kept_edges(),
                     [&](const Edge& edge) { return io::rank_colour(edge.rank / last); });
        });
    made.colour_bars = {
        {io::rank_colour, "1", fmt::format("{}", std::max<std::size_t>(set.kept, 1))}};
    return made;
  }

  [[nodiscard]] Panel mask() const {
    std::size_t edgels = 0;
    for (const Edge& edge : found_.edges.kept_edges()) {
      edgels += edge.edgels.count;
    }
    return panel(
        "Result: mask of the kept edges",
        fmt::format("{}, {}.", plural(found_.edges.kept, "edge"), plural(edgels, "edge pixel")),
        map_picture(mask_));
  }

  [[nodiscard]] Panel times() const {
    std::vector<TableRow> rows = {{{"step", "ms"}, false}};
    for (const StageTime& time : found_.times) {
      rows.push_back({{std::string(time.stage), fmt::format("{:.2f}", time.ms)}, false});
    }
    rows.push_back({{"whole frame", fmt::format("{:.2f}", total_ms(found_.times))}, true});
    Panel made =
        panel("Time of each step", "one run on this machine; thermedge bench gives medians.",
              [rows = std::move(rows)](Canvas& canvas, const Box& box) {
                draw_table(canvas, box, rows, 0.3);
              });
    made.bordered = false;
    return made;
  }

  const DetectorOptions& options_;
  const Detection& found_;
  const Intermediates& steps_;
  std::span<const Denoised> denoised_;
  ImageView<const std::uint8_t> mask_;
  int bits_;
  double gain_ = GreyScaleOptions{}.gain;  // of the 8-bit view
};

constexpr std::string_view kStepNames[] = {"frame",   "levels", "edge_pixels", "contours", "links",
                                           "corners", "score",  "rank",        "mask",     "times"};

// "03_denoised_nlm" ...: two steps come before the denoisers, the others after them.
std::vector<std::string> step_names(std::span<const Denoised> denoised) {
  std::vector<std::string> names(std::begin(kStepNames), std::end(kStepNames));
  std::vector<std::string> methods;
  for (const Denoised& picture : denoised) {
    for (const auto& known : kDenoiseMethods) {
      if (known.value == picture.method) {
        methods.push_back(fmt::format("denoised_{}", known.name));
      }
    }
  }
  names.insert(names.begin() + 2, methods.begin(), methods.end());
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = fmt::format("{:02}_{}", i + 1, names[i]);
  }
  return names;
}

}  // namespace

struct StagesSheet::Impl {
  DetectorOptions options;
  double wanted_width = kPanelWidth;
  std::vector<std::pair<DenoiseMethod, Detector>> detectors;  // the chosen one last
  std::vector<Denoised> denoised;
  Detection detection;
  Intermediates steps;
  Image<std::uint8_t> mask;

  Result<StagesFigures> draw(ImageView<const std::uint16_t> frame, int bits,
                             const std::string& source, ImageView<const std::uint8_t> valid);
};

Result<StagesFigures> StagesSheet::Impl::draw(ImageView<const std::uint16_t> frame, int bits,
                                              const std::string& source,
                                              ImageView<const std::uint8_t> valid) {
  denoised.clear();
  Frame given(frame, bits);
  given.valid = valid;
  for (auto& [method, detector] : detectors) {
    // The first run on a frame's size allocates; the second shows the usual times.
    Status status = detector.detect(given, detection).and_then([&, &again = detector] {
      return again.detect(given, detection, {&steps, {}});
    });
    if (!status) {
      return tl::unexpected(status.error());
    }
    const auto denoise =
        std::find_if(detection.times.begin(), detection.times.end(),
                     [](const StageTime& time) { return time.stage == "denoise"; });
    denoised.push_back({method, steps.denoised.clone(), denoise->ms});
  }
  // On the sheet NL-means comes before BM3D, whichever was chosen.
  std::sort(denoised.begin(), denoised.end(),
            [](const Denoised& a, const Denoised& b) { return a.method < b.method; });
  mask.resize(frame.width(), frame.height());
  draw_mask(detection.edges, mask);

  const std::vector<Panel> panels =
      StagePanels(options, detection, steps, denoised, mask.view(), bits).all();
  const double panel_width = panel_width_for(frame.width(), wanted_width);
  const SheetText text = {
      .title = "From the frame to its edges, step by step",
      .subtitle = fmt::format("{}, {} x {} pixels, preset {}", source, frame.width(),
                              frame.height(), preset_name(options.preset())),
      .footer =
          "Steps after Vu Hoang Minh et al. 2017, sections 2.3 to 4.2. Colours keep their "
          "order in grey."};
  StagesFigures figures{make_sheet(text, panels, kColumns, panel_width), {}};
  const std::vector<std::string> names = step_names(denoised);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    figures.steps.push_back({names[i], make_single(panels[i], panel_width)});
  }
  return figures;
}

Result<StagesSheet> StagesSheet::create(const DetectorOptions& options, double wanted_width) {
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->wanted_width = wanted_width;
  std::vector<DenoiseMethod> methods = {DenoiseMethod::kNlm, DenoiseMethod::kBm3d};
  std::erase(methods, options.denoise.method);
  methods.push_back(options.denoise.method);
  for (const DenoiseMethod method : methods) {
    DetectorOptions chosen = options;
    chosen.denoise.method = method;
    auto detector = Detector::create(chosen);
    if (!detector) {
      return tl::unexpected(detector.error());
    }
    impl->detectors.emplace_back(method, std::move(*detector));
  }
  return StagesSheet(std::move(impl));
}

StagesSheet::StagesSheet(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StagesSheet::StagesSheet(StagesSheet&&) noexcept = default;
StagesSheet& StagesSheet::operator=(StagesSheet&&) noexcept = default;
StagesSheet::~StagesSheet() = default;

Result<StagesFigures> StagesSheet::draw(ImageView<const std::uint16_t> frame, int bits,
                                        const std::string& source,
                                        ImageView<const std::uint8_t> valid) {
  try {
    return impl_->draw(frame, bits, source, valid);
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, "sheet of stages: out of memory");
  }
}

}  // namespace thermedge::figures
