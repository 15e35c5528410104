#include "thermedge/figures/probe_sheet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "chart.hpp"
#include "frame_panels.hpp"
#include "thermedge/io/colour_map.hpp"

namespace thermedge::figures {
namespace {

constexpr int kColumns = 3;
constexpr double kLevels = 255;
constexpr Rgb kData = {40, 90, 150};
constexpr Rgb kSecondData = {213, 94, 0};
constexpr double kEvenWithin = 0.2;  // of the middle sigma
constexpr Rgb kNotMeasured = {225, 227, 230};
constexpr double kClearStripes = 0.25;  // share of sigma, from which stripes cost faint edges

class ProbePanels {
 public:
  ProbePanels(const RecordingReport& report, ImageView<const std::uint16_t> frame)
      : report_(report),
        frame_(frame),
        aspect_(static_cast<double>(report.height) / report.width),
        unit_(report.container_bits == 8 ? "levels" : "counts") {}

  [[nodiscard]] std::vector<Panel> all() const {
    std::vector<Panel> panels = {
        frame(),
        histogram(),
        noise_map(),
        spectrum(),
        stripes("Offsets of the columns", "column, px", report_.column_profile_counts,
                report_.column_sigma_counts),
        stripes("Offsets of the rows", "row, px", report_.row_profile_counts,
                report_.row_sigma_counts)};
    if (report_.frames > 1) {
      panels.push_back(series());
    }
    return panels;
  }

 private:
  [[nodiscard]] Panel panel(std::string title, std::string note, Draw draw) const {
    return {.title = std::move(title),
            .note = std::move(note),
            .aspect = aspect_,
            .bordered = false,
            .draw = std::move(draw)};
  }

  [[nodiscard]] Panel frame() const {
    Panel made =
        panel("First frame",
              fmt::format("{} x {} pixels, {} of {} bits used; shown from the 0.5th to the "
                          "99.5th percentile.",
                          report_.width, report_.height, report_.used_bits, report_.container_bits),
              frame_picture(frame_));
    made.bordered = true;
    return made;
  }

  [[nodiscard]] Panel histogram() const {
    return panel(
        "Histogram",
        fmt::format("98 of 100 pixels within {:.0f} {}; bars: what Algorithm 1 can show at a "
                    "gain.",
                    report_.robust_range_counts, unit_),
        [this](Canvas& canvas, const Box& box) { draw_histogram(canvas, box); });
  }

  void draw_histogram(Canvas& canvas, const Box& box) const {
    const CountHistogram& histogram = report_.histogram;
    const std::vector<double> edges(histogram.edges_counts.begin(), histogram.edges_counts.end());
    const double pixels =
        static_cast<double>(report_.frames) * report_.width * static_cast<double>(report_.height);
    std::vector<double> shares;
    double highest = 0;
    for (const std::int64_t count : histogram.pixels) {
      shares.push_back(100 * static_cast<double>(count) / pixels);
      highest = std::max(highest, shares.back());
    }
    // The upper part is for the bars.
    Chart chart(canvas, box, {edges.front(), edges.back()}, {0, std::max(1.6 * highest, 1e-6)},
                unit_, "% of the pixels");
    chart.columns(edges, shares, kData);
    if (report_.container_bits == 8) {
      return;
    }
    const double median = report_.series.empty() ? 0 : report_.series.front().median_counts;
    int row = 0;
    for (const GainClipping& entry : report_.clipping) {
      if (!is_of_interest(entry.gain)) {
        continue;
      }
      chart.bar(median - 127 / entry.gain, median + (kLevels - 127) / entry.gain, row++,
                kSecondData,
                fmt::format("gain {:g}: {:.1f} % clipped", entry.gain, 100 * entry.share));
    }
  }

  // The paper's gain, the one that suits its camera, and the one that suits this recording.
  [[nodiscard]] bool is_of_interest(double gain) const {
    return gain == 0.5 || gain == 0.2 ||
           std::any_of(report_.suggested.begin(), report_.suggested.end(),
                       [&](const SuggestedOption& option) {
                         return option.name == "grey_scale.gain" &&
                                option.value == fmt::format("{:g}", gain);
                       });
  }

  [[nodiscard]] Panel noise_map() const {
    const NoiseMap& map = report_.noise_map;
    std::vector<double> sorted = map.sigma_counts;
    std::sort(sorted.begin(), sorted.end());
    // Without the outermost tiles, which one busy corner would make the whole range; wide enough
    // that even noise is of one colour.
    const double lowest = sorted.empty() ? 0 : sorted[sorted.size() / 20];
    const double highest = sorted.empty() ? 0 : sorted[sorted.size() - 1 - sorted.size() / 20];
    const double middle = (lowest + highest) / 2;
    const double low = std::min(lowest, (1 - kEvenWithin) * middle);
    const double high = std::max({highest, (1 + kEvenWithin) * middle, low + 1e-3});
    Panel made = panel(
        "Noise over the picture",
        fmt::format("sigma {:.2f} {}, as detect tells it; one colour all over is even noise.",
                    report_.sigma_counts, unit_),
        [&map, low, high](Canvas& canvas, const Box& box) {
          if (map.sigma_counts.empty()) {
            return;
          }
          Image<Rgb> tiles(map.columns, map.rows);
          for (int y = 0; y < map.rows; ++y) {
            for (int x = 0; x < map.columns; ++x) {
              const double sigma = map.sigma_counts[static_cast<std::size_t>(y) *
                                                        static_cast<std::size_t>(map.columns) +
                                                    static_cast<std::size_t>(x)];
              tiles(x, y) = io::plasma((sigma - low) / (high - low));
            }
          }
          canvas.picture(tiles.view(), box);
        });
    made.bordered = true;
    made.colour_bars = {
        {io::plasma, fmt::format("{:.2f}", low), fmt::format("{:.2f} {}", high, unit_)}};
    return made;
  }

  // The 8 x 8 variances as squares, the period of each frequency beside its row and column.
  [[nodiscard]] Panel spectrum() const {
    const double stripes = std::max(report_.column_sigma_counts, report_.row_sigma_counts);
    std::string note(noise_kind_meaning(report_.noise_kind));
    if (stripes > kClearStripes * report_.sigma_counts) {
      note += "; stripes: bright along the upper or the left side";
    }
    Panel made = panel("Spectrum of the noise: " + kind_text(), note + ".",
                       [this](Canvas& canvas, const Box& box) { draw_spectrum(canvas, box); });
    made.colour_bars = {{io::plasma, "1/16", "4 times the square of sigma"}};
    return made;
  }

  [[nodiscard]] std::string kind_text() const {
    std::string text(std::find_if(kNoiseKinds.begin(), kNoiseKinds.end(), [&](const auto& known) {
                       return known.value == report_.noise_kind;
                     })->name);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
  }

  void draw_spectrum(Canvas& canvas, const Box& box) const {
    if (report_.sigma_counts == 0) {
      return;
    }
    const double unit = box.width / 100;
    const double side = std::min(box.width - 38 * unit, box.height - 14 * unit);
    const Box square{box.x + (box.width - side) / 2, box.y + unit, side, side};
    Image<Rgb> cells(kNoiseBlockPx, kNoiseBlockPx);
    const NoiseSpectrum variances = report_.spectrum_with_stripes();
    for (int v = 0; v < kNoiseBlockPx; ++v) {
      for (int u = 0; u < kNoiseBlockPx; ++u) {
        const auto variance =
            static_cast<double>(variances[static_cast<std::size_t>(v * kNoiseBlockPx + u)]);
        cells(u, v) = u + v == 0 ? kNotMeasured : io::plasma((std::log2(variance) + 4) / 6);
      }
    }
    canvas.picture(cells.view(), square);
    TextStyle style{.size = 2.7 * unit, .colour = kSoftInk, .align = Align::kCentre};
    const double cell = side / kNoiseBlockPx;
    for (int i = 0; i < kNoiseBlockPx; ++i) {
      const std::string period = i == 0 ? "none" : fmt::format("{:.2g}", 2.0 * kNoiseBlockPx / i);
      style.align = Align::kCentre;
      canvas.text({square.x + (i + 0.5) * cell, square.bottom() + 3.6 * unit}, period, style);
      style.align = Align::kRight;
      canvas.text({square.x - unit, square.y + (i + 0.5) * cell + unit}, period, style);
    }
    style.colour = kInk;
    style.align = Align::kCentre;
    canvas.text({square.x + side / 2, square.bottom() + 8 * unit}, "period across, px", style);
    style.align = Align::kRight;
    canvas.text({square.x - 8 * unit, square.y + side / 2 - unit}, "period", style);
    canvas.text({square.x - 8 * unit, square.y + side / 2 + 2.5 * unit}, "down, px", style);
  }

  // Profiles of one scale in both panels, so that they can be compared.
  [[nodiscard]] Panel stripes(std::string title, const std::string& label,
                              const std::vector<double>& profile, double sigma) const {
    double largest = 0.1;
    for (const auto* both : {&report_.column_profile_counts, &report_.row_profile_counts}) {
      for (const double offset : *both) {
        largest = std::max(largest, std::abs(offset));
      }
    }
    const double share = report_.sigma_counts > 0 ? 100 * sigma / report_.sigma_counts : 0;
    return panel(std::move(title),
                 fmt::format("stripes of sigma {:.2f} {}: {:.0f} % of the noise; above 25 % they "
                             "cost faint edges.",
                             sigma, unit_, share),
                 [this, largest, label, &profile](Canvas& canvas, const Box& box) {
                   std::vector<Point> points;
                   for (std::size_t i = 0; i < profile.size(); ++i) {
                     points.push_back({static_cast<double>(i), profile[i]});
                   }
                   Chart chart(canvas, box,
                               widened({0, static_cast<double>(profile.size()) - 1}, 0),
                               widened({-largest, largest}, 0.05), label, unit_);
                   chart.horizontal(0, kSoftInk);
                   chart.line(points, kData);
                 });
  }

  [[nodiscard]] Panel series() const {
    return panel("Median over time",
                 fmt::format("{} frames, {} repeated; the median moves by {:.2f} {} a frame.",
                             report_.frames, report_.repeated_frames,
                             report_.flicker_counts.value_or(0), unit_),
                 [this](Canvas& canvas, const Box& box) {
                   std::vector<Point> points;
                   Interval y{1e9, -1e9};
                   for (const ProbeSample& sample : report_.series) {
                     points.push_back({static_cast<double>(sample.frame),
                                       static_cast<double>(sample.median_counts)});
                     y.min = std::min(y.min, points.back().y);
                     y.max = std::max(y.max, points.back().y);
                   }
                   Chart chart(canvas, box, widened({points.front().x, points.back().x}, 0),
                               widened(y, 0.1), "frame", unit_);
                   chart.line(points, kData);
                 });
  }

  const RecordingReport& report_;
  ImageView<const std::uint16_t> frame_;
  double aspect_;
  std::string unit_;
};

}  // namespace

Figure draw_probe(const RecordingReport& report, ImageView<const std::uint16_t> frame,
                  const std::string& source, double panel_width) {
  const ProbePanels drawn(report, frame);  // the panels refer to it
  const std::vector<Panel> panels = drawn.all();
  const SheetText text = {
      .title = "What this recording is like",
      .subtitle = fmt::format("{}: {} frame{}, SNR {}", source, report.frames,
                              report.frames == 1 ? "" : "s",
                              report.snr ? fmt::format("{:.0f}", *report.snr) : "unknown"),
      .footer = "thermedge probe prints all figures, what they mean and which options suit."};
  return make_sheet(text, panels, kColumns, panel_width_for(report.width, panel_width));
}

}  // namespace thermedge::figures
