#include "probe_page.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "thermedge/io/probe_file.hpp"
#include "thermedge/options.hpp"

namespace thermedge::cli {
namespace {

// A word for a value: the first whose limit it does not exceed.
struct Grade {
  double limit;
  std::string_view word;
};

template <std::size_t N>
std::string_view grade(const Grade (&grades)[N], double value) {
  for (const Grade& entry : grades) {
    if (value <= entry.limit) {
      return entry.word;
    }
  }
  return grades[N - 1].word;
}

constexpr double kAnything = 1e300;

// Grades of the noise of a pixel, degC. Makers of uncooled cameras state 0.03 to 0.06 (NETD).
constexpr Grade kSigmaGrades[] = {{0.03, "very good for an uncooled camera"},
                                  {0.07, "usual for an uncooled camera"},
                                  {0.12, "noisy: a denoiser is worth its time"},
                                  {kAnything, "very noisy: a denoiser is needed"}};
constexpr Grade kSnrGrades[] = {{15, "poor: strong edges only"},
                                {60, "low, as of small cheap cameras"},
                                {200, "usual"},
                                {kAnything, "good"}};
// Grades of stripes, as shares of the sigma of the pixels.
constexpr Grade kStripeGrades[] = {{0.125, "none to be seen"},
                                   {0.25, "weak, harmless"},
                                   {0.4, "clear: they cost faint edges"},
                                   {kAnything, "strong: correct them first"}};

// Of a variance, in units of the square of sigma: a factor of two a step.
constexpr Grade kShades[] = {{0.18, " "}, {0.35, "."}, {0.7, ":"},
                             {1.4, "o"},  {2.8, "O"},  {kAnything, "@"}};
// Most cells of the map in text.
constexpr int kMapColumns = 6;
constexpr int kMapRows = 4;

class Page {
 public:
  explicit Page(const RecordingReport& report) : report_(report) {}

  std::string text(const std::string& name) {
    text_ = fmt::format("{}: {} frame{} of {}x{} pixels\n", name, report_.frames,
                        report_.frames == 1 ? "" : "s", report_.width, report_.height);
    input();
    range();
    noise();
    stripes();
    spectrum();
    invalid_pixels();
    bad_pixels();
    clipping();
    sequence();
    suggestions();
    return std::move(text_);
  }

 private:
  void heading(std::string_view title) { text_ += fmt::format("\n{}\n", title); }
  void row(std::string_view label, const std::string& value, std::string_view meaning) {
    text_ += fmt::format("  {:<15} {:<26} {}\n", label, value, meaning);
  }
  void more(std::string_view meaning) { row("", "", meaning); }

  // 8-bit pictures have levels, whose worth nobody knows.
  [[nodiscard]] bool has_counts() const { return report_.container_bits == 16; }
  [[nodiscard]] bool has_degrees() const { return has_counts() && !report_.is_degc_implausible; }
  [[nodiscard]] std::string_view unit() const { return has_counts() ? "counts" : "levels"; }
  [[nodiscard]] std::string amount(double counts, int digits) const {
    if (!has_degrees()) {
      return fmt::format("{:.{}f} {}", counts, digits, unit());
    }
    return fmt::format("{:.{}f} counts = {:.{}f} degC", counts, digits,
                       counts * report_.degc_per_count, std::min(digits + 2, 3));
  }
  static std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

  // The remedy, where there is one.
  [[nodiscard]] std::string lost_to_clipping() const {
    for (const SuggestedOption& option : report_.suggested) {
      if (option.name == "grey_scale.gain") {
        return fmt::format("edges there are lost: use --set {}={}", option.name, option.value);
      }
    }
    return "edges there are lost";
  }

  void input();
  void range();
  void degrees();
  void noise();
  void fixed_pattern();
  void spectrum();
  [[nodiscard]] std::string map_row(int row) const;
  void stripes();
  void invalid_pixels();
  void bad_pixels();
  void clipping();
  void sequence();
  void suggestions();

  const RecordingReport& report_;
  std::string text_;
};

void Page::input() {
  if (report_.input.empty()) {
    return;
  }
  heading("Input: options that mend what these frames show");
  for (const InputFault& fault : report_.input) {
    row("", fault.flag + " " + fault.value, fault.reason);
  }
  more("What follows is of the frames as they are: probe again with it.");
}

// Temperatures, or why there are none.
void Page::degrees() {
  if (!has_counts()) {
    return;
  }
  if (report_.is_degc_implausible) {
    const auto [low, high] = report_.implausible_degc;
    row("", fmt::format("{:.0f} to {:.0f} degC: implausible", low, high),
        fmt::format("for a scene with {:.2g} degC of noise: --camera is not",
                    report_.implausible_sigma_degc));
    more("that of this recording. Give its own scale, or confirm this one in");
    more("numbers: --camera linear:DEGC_PER_COUNT,DEGC_AT_ZERO");
  } else if (report_.min_degc && report_.max_degc) {
    row("", fmt::format("{:.1f} to {:.1f} degC", *report_.min_degc, *report_.max_degc),
        report_.camera_source == CameraSource::kName
            ? "as temperatures of black bodies, by the camera's response"
            : "as temperatures, by the response given or stored");
  }
  if (report_.is_degc_assumed) {
    row("a count", fmt::format("{:g} degC", report_.degc_per_count),
        "assumed; --camera or --degc-per-count tells it");
  }
}

void Page::range() {
  heading("Range");
  row("bits", fmt::format("{} of {} used", report_.used_bits, report_.container_bits),
      has_counts() ? "raw counts, as they should be"
                   : "scaled already: the camera's raw 16 bits are better");
  if (report_.unused_low_bits > 0) {
    more(fmt::format("all counts are multiples of {}: shifted by {} bits, which is harmless",
                     1 << report_.unused_low_bits, report_.unused_low_bits));
  }
  row("of all frames", fmt::format("{} to {} {}", report_.min_counts, report_.max_counts, unit()),
      "the coldest and the hottest pixel, bad ones included");
  degrees();
  row("of a frame", amount(report_.range_counts, 0), "its hottest minus its coldest pixel (eq. 3)");
  row("most of it", amount(report_.robust_range_counts, 0), "from the 1st to the 99th percentile");
}

void Page::noise() {
  heading("Noise (standard deviation)");
  const double sigma = report_.sigma_counts;
  if (sigma == 0) {
    row("sigma", "none", "constant, drawn or processed, or too small to tell");
    return;
  }
  row("sigma", amount(sigma, 2),
      has_degrees()  ? grade(kSigmaGrades, sigma * report_.degc_per_count)
      : has_counts() ? "what detect tells of these frames"
                     : "whatever the camera's automatic gain made of it");
  if (report_.sigma_value) {
    row("", fmt::format("{:.4g}", *report_.sigma_value),
        "in the unit of the file, as detect tells it");
  }
  std::vector<double> tiles = report_.noise_map.sigma_counts;
  std::sort(tiles.begin(), tiles.end());
  const double low = tiles[tiles.size() / 10];
  const double high = tiles[tiles.size() - 1 - tiles.size() / 10];
  row("in the picture", fmt::format("{:.1f} to {:.1f}", low, high),
      high < 1.5 * low ? "even" : "uneven, see the map: detect goes by it");
  row("pixel to pixel", fmt::format("{:.2f}", report_.pixel_sigma_counts),
      "between neighbours; sigma is over 5 to 16 px");
  if (report_.temporal_sigma_counts) {
    row("over time", fmt::format("{:.2f}", *report_.temporal_sigma_counts),
        "new in every frame, of each pixel: averaging helps");
  }
  fixed_pattern();
  if (report_.snr) {
    row("SNR", fmt::format("{:.0f}", *report_.snr),
        fmt::format("most of the range / sigma; {}", grade(kSnrGrades, *report_.snr)));
  }
}

void Page::fixed_pattern() {
  if (!report_.fixed_pattern_sigma_counts) {
    row("fixed", "unknown", "needs 4 frames between which the scene moves");
    return;
  }
  row("fixed", fmt::format("{:.2f}", *report_.fixed_pattern_sigma_counts),
      fmt::format("offsets of the pixels: {} of the variance",
                  percent(*report_.fixed_pattern_share)));
  more(fmt::format("a map of 8 frames lowers sigma by {}, at best {}",
                   percent(*report_.offset_map_gain_8_frames),
                   percent(*report_.offset_map_gain_limit)));
}

void Page::stripes() {
  const double sigma = report_.sigma_counts;
  if (sigma == 0) {
    return;
  }
  row("columns", fmt::format("{:.2f}", report_.column_sigma_counts),
      fmt::format("vertical stripes: {}",
                  grade(kStripeGrades, report_.column_sigma_counts / sigma)));
  row("rows", fmt::format("{:.2f}", report_.row_sigma_counts),
      fmt::format("horizontal stripes: {}",
                  grade(kStripeGrades, report_.row_sigma_counts / sigma)));
}

// Mean of sigma over the tiles of a cell.
std::string Page::map_row(int row) const {
  const NoiseMap& map = report_.noise_map;
  const int rows = std::min(map.rows, kMapRows);
  const int columns = std::min(map.columns, kMapColumns);
  std::string text;
  for (int column = 0; column < columns && row < rows; ++column) {
    double sum = 0;
    int tiles = 0;
    for (int y = row * map.rows / rows; y < (row + 1) * map.rows / rows; ++y) {
      for (int x = column * map.columns / columns; x < (column + 1) * map.columns / columns; ++x) {
        sum += map.sigma_counts[static_cast<std::size_t>(y * map.columns + x)];
        ++tiles;
      }
    }
    const double sigma = sum / tiles;
    text += fmt::format("{:>7.{}f}", sigma, sigma < 1 ? 3 : sigma < 100 ? 1 : 0);
  }
  return text;
}

void Page::spectrum() {
  if (report_.sigma_counts == 0) {
    return;
  }
  std::string kind(std::find_if(kNoiseKinds.begin(), kNoiseKinds.end(), [&](const auto& known) {
                     return known.value == report_.noise_kind;
                   })->name);
  std::replace(kind.begin(), kind.end(), '_', ' ');
  row("spectrum", kind, noise_kind_meaning(report_.noise_kind));
  text_ += fmt::format("\n  {:<44} spectrum, slow to fine: rightwards across,\n",
                       fmt::format("map: sigma over the picture, {}", unit()));
  text_ += fmt::format("  {:<44} downwards along the columns\n", "");
  const NoiseSpectrum variances = report_.spectrum_with_stripes();
  for (int v = 0; v < kNoiseBlockPx; ++v) {
    text_ += fmt::format("  {:<44} ", map_row(v));
    for (int u = 0; u < kNoiseBlockPx; ++u) {
      const auto variance =
          static_cast<double>(variances[static_cast<std::size_t>(v * kNoiseBlockPx + u)]);
      text_ += fmt::format(" {}", u + v > 0 ? grade(kShades, variance) : " ");
    }
    text_ += "\n";
  }
  text_ +=
      "  @ O o : . and blank: each half the variance of the one before; o all over is white, "
      "blank at\n  the lower right smooth, @ along the upper or left side stripes\n";
}

// Said only where there are some.
void Page::invalid_pixels() {
  const bool is_any = report_.given_invalid_pixels + report_.found_invalid_pixels > 0;
  if (!is_any && report_.dead_rows + report_.dead_columns == 0) {
    return;
  }
  heading("Pixels that are no measurement");
  const auto a_frame = [](double number) { return fmt::format("{:.1f} a frame", number); };
  if (report_.given_invalid_pixels > 0) {
    row("given", a_frame(report_.given_invalid_pixels), "filled, and kept clear of edges");
  }
  if (report_.found_invalid_pixels > 0) {
    row("found", a_frame(report_.found_invalid_pixels),
        "black corners, bars, telemetry, dead blocks: the same");
  }
  if (report_.dead_rows > 0) {
    row("dead rows", a_frame(report_.dead_rows), "replaced by those beside them");
  }
  if (report_.dead_columns > 0) {
    row("dead columns", a_frame(report_.dead_columns), "replaced by those beside them");
  }
}

void Page::bad_pixels() {
  heading("Dead pixels");
  if (!report_.bad_pixels) {
    row("flagged", fmt::format("{:.1f} a frame", report_.passing_bad_pixels),
        "replaced by detect; 3 frames would tell if they last");
    return;
  }
  row("lasting", fmt::format("{}", *report_.bad_pixels),
      *report_.bad_pixels == 0 ? "none: good" : "replaced by detect on every frame");
  row("passing", fmt::format("{:.1f} a frame", report_.passing_bad_pixels),
      "flagged now and then: flicker, or points of the scene");
}

// The other presets of the detector work on counts.
void Page::clipping() {
  if (!has_counts()) {
    return;
  }
  const bool is_used = report_.preset == Preset::kPaper;
  heading(is_used ? "Algorithm 1 (8 bits around the median)"
                  : "Algorithm 1 (8 bits around the median), for scale and preset paper only");
  for (const double gain : {0.5, 0.2}) {
    const double share = report_.clipped_share(gain);
    row(fmt::format("gain {}", gain), percent(share) + " clipped",
        share <= 0.02 ? "good"
        : is_used     ? lost_to_clipping()
                      : "edges there would be lost");
  }
}

void Page::sequence() {
  if (report_.frames < 2) {
    return;
  }
  heading("Sequence");
  row("repeated", fmt::format("{} frames", report_.repeated_frames),
      report_.repeated_frames == 0 ? "none: good" : "same bits as the frame before");
  if (report_.longest_freeze > 1) {
    row("longest freeze", fmt::format("{} frames", report_.longest_freeze),
        "a shutter (FFC) or a stalled stream: nothing new to see meanwhile");
  }
  if (report_.offset_jumps > 0) {
    row("shutter jumps", fmt::format("{}", report_.offset_jumps),
        fmt::format("all counts shift after a freeze, by up to {:.0f}",
                    report_.largest_jump_counts));
  }
  row("movement", fmt::format("{} in {} frames", report_.scene_moved, report_.frames),
      report_.scene_moved == 0 ? "camera at rest" : "times the scene had moved enough to notice");
  row("flicker", amount(report_.flicker_counts.value_or(0), 2),
      "change of the median from frame to frame");
  if (has_counts()) {
    more(fmt::format("= {:.2f} grey levels of Algorithm 1 at gain 0.5",
                     0.5 * report_.flicker_counts.value_or(0)));
  }
}

void Page::suggestions() {
  heading("Suggested options (for --set, or with --toml FILE for detect --config FILE)");
  text_ += io::suggested_toml(report_);
}

}  // namespace

std::string probe_page(const RecordingReport& report, const std::string& name) {
  return Page(report).text(name);
}

}  // namespace thermedge::cli
