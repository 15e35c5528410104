#include "radiometer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thermedge/radiometry/planck.hpp"

namespace thermedge::sim {

// Radiance every degree from 0 K on. Rounded to 2^-20 W m^-2 sr^-1 (0.00013 counts): the C
// library's last bit, in which machines may differ, is a thousand million times smaller.
class RadianceTable {
 public:
  static const RadianceTable& instance() {
    static const RadianceTable kTable;
    return kTable;
  }

  RadianceTable() {
    constexpr double kSteps = 1 << 20;
    for (std::size_t kelvin = 1; kelvin < values_.size(); ++kelvin) {
      values_[kelvin] = std::round(band_radiance(static_cast<double>(kelvin)) * kSteps) / kSteps;
    }
  }

  // Cubic through the four nearest entries.
  [[nodiscard]] double at(double kelvin) const {
    const double bounded = std::clamp(kelvin, 1.0, kLast - 2.0);
    const auto i = static_cast<std::size_t>(bounded);
    const double t = bounded - static_cast<double>(i);
    const double* v = &values_[i];
    return v[0] * (t - 1) * (t - 2) * (t + 1) / 2 - v[1] * (t + 1) * t * (t - 2) / 2 +
           v[2] * (t + 1) * t * (t - 1) / 6 - v[-1] * t * (t - 1) * (t - 2) / 6;
  }

 private:
  static constexpr int kLast = 1400;
  std::array<double, kLast + 1> values_{};
};

namespace {

constexpr double kReferenceDegC = 25;

double radiance(double degc) { return RadianceTable::instance().at(degc + kKelvinAtZeroCelsius); }

// Radiance that is worth a count at 25 degC.
double radiance_per_count() {
  return (radiance(kReferenceDegC + 0.5) - radiance(kReferenceDegC - 0.5)) * kDegcPerCount;
}

}  // namespace

Radiometer::Radiometer(double reflected_degc)
    : table_(&RadianceTable::instance()),
      reflected_(radiance(reflected_degc)),
      reference_(radiance(kReferenceDegC)),
      counts_per_radiance_(1 / radiance_per_count()) {}

double Radiometer::counts(double temperature_degc, double emissivity) const {
  const double own = table_->at(temperature_degc + kKelvinAtZeroCelsius);
  const double seen = emissivity * own + (1 - emissivity) * reflected_;
  return kCountsAt25DegC + (seen - reference_) * counts_per_radiance_;
}

}  // namespace thermedge::sim
