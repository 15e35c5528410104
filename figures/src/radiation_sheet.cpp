#include "thermedge/figures/radiation_sheet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "chart.hpp"
#include "sheet.hpp"
#include "thermedge/io/colour_map.hpp"

namespace thermedge::figures {
namespace {

constexpr std::size_t kMostCurves = 8;
constexpr std::array kGlowing = {3000.0, 4000.0, 5000.0, 6000.0};
constexpr double kAspect = 0.75;
constexpr Rgb kBand = {226, 232, 240};

// From blue for the coldest to orange for the hottest: the ends of the map would be lost on paper.
Rgb curve_colour(std::size_t index, std::size_t curves) {
  const double share =
      curves > 1 ? static_cast<double>(index) / static_cast<double>(curves - 1) : 0.5;
  return io::plasma(0.05 + 0.75 * share);
}

// Wavelengths that show all of the coldest curve that matters.
Interval wavelengths_of(std::span<const double> temperatures_k) {
  const double coldest = *std::min_element(temperatures_k.begin(), temperatures_k.end());
  return {0, 2.8 * wien_peak_um(coldest)};
}

double highest_radiance(std::span<const double> temperatures_k) {
  const double hottest = *std::max_element(temperatures_k.begin(), temperatures_k.end());
  return planck_radiance(wien_peak_um(hottest), hottest);
}

void draw_curves(Canvas& canvas, const Box& box, std::span<const double> temperatures_k,
                 const Band* band) {
  constexpr int kSteps = 400;
  const Interval x = wavelengths_of(temperatures_k);
  const Interval y = {0, 1.08 * highest_radiance(temperatures_k)};
  Chart chart(canvas, box, x, y, "wavelength, um", "W / (m2 sr um)");
  if (band != nullptr) {
    const double edges[] = {std::min(band->low_um, x.max), std::min(band->high_um, x.max)};
    const double heights[] = {y.max};
    chart.columns(edges, heights, kBand);
  }
  for (std::size_t i = 0; i < temperatures_k.size(); ++i) {
    const double kelvin = temperatures_k[i];
    const Rgb colour = curve_colour(i, temperatures_k.size());
    std::vector<Point> points;
    for (int step = 1; step <= kSteps; ++step) {
      const double wavelength = x.max * step / kSteps;
      points.push_back({wavelength, planck_radiance(wavelength, kelvin)});
    }
    chart.line(points, colour);
    const Point maximum[] = {{wien_peak_um(kelvin), planck_radiance(wien_peak_um(kelvin), kelvin)}};
    chart.line(maximum, colour);
    chart.label(maximum[0], fmt::format("{:g} K", kelvin), colour);
  }
}

Panel panel_of(std::string title, const std::string& note, std::span<const double> temperatures_k,
               const Band* band) {
  std::string maxima;
  for (const double kelvin : temperatures_k) {
    maxima += fmt::format("{}{:.3g} um at {:g} K", maxima.empty() ? "" : ", ", wien_peak_um(kelvin),
                          kelvin);
  }
  return {.title = std::move(title),
          .note = "Maxima: " + maxima + ". " + note,
          .aspect = kAspect,
          .bordered = false,
          .draw = [=](Canvas& canvas, const Box& box) {
            draw_curves(canvas, box, temperatures_k, band);
          }};
}

Status check(std::span<const double> temperatures_k, const Band& band) {
  if (temperatures_k.empty() || temperatures_k.size() > kMostCurves) {
    return failure(ErrorCode::kInvalidArgument,
                   fmt::format("there should be 1 to {} temperatures", kMostCurves));
  }
  for (const double kelvin : temperatures_k) {
    if (!(kelvin >= kLowestKelvin && kelvin <= kHighestKelvin)) {
      return failure(ErrorCode::kInvalidArgument,
                     fmt::format("a temperature of {:g} K: should be {:g} to {:g} K", kelvin,
                                 kLowestKelvin, kHighestKelvin));
    }
  }
  if (!(band.low_um > 0 && band.high_um > band.low_um)) {
    return failure(ErrorCode::kInvalidArgument,
                   fmt::format("a band of {:g} to {:g} um: should be positive and not empty",
                               band.low_um, band.high_um));
  }
  return {};
}

}  // namespace

Result<Figure> draw_radiation(std::span<const double> temperatures_k, const Band& band,
                              double panel_width) {
  return check(temperatures_k, band).map([&] {
    std::string shares;
    for (const double kelvin : temperatures_k) {
      const Band all = {0.001 * wien_peak_um(kelvin), 1000 * wien_peak_um(kelvin)};
      shares += fmt::format("{}{:.0f} % at {:g} K", shares.empty() ? "" : ", ",
                            100 * band_radiance(kelvin, band) / band_radiance(kelvin, all), kelvin);
    }
    const std::vector<Panel> panels = {
        panel_of(
            "Bodies that a thermal camera sees",
            fmt::format("Shaded: the camera's band, {:g} to {:g} um. It holds of all radiation "
                        "{}.",
                        band.low_um, band.high_um, shares),
            temperatures_k, &band),
        panel_of("Glowing bodies", "Their maxima lie in or near visible light, 0.4 to 0.7 um.",
                 kGlowing, nullptr)};
    const SheetText text = {
        .title = "Thermal radiation",
        .subtitle =
            "spectral radiance of black bodies by Planck's law (eq. 1); discs: maxima by "
            "Wien's displacement law (eq. 2)",
        .footer = "After figure 2 of Vu Hoang Minh et al. 2017."};
    return make_sheet(text, panels, static_cast<int>(panels.size()), panel_width);
  });
}

}  // namespace thermedge::figures
