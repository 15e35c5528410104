// From temperatures to counts.
#pragma once

namespace thermedge::sim {

class RadianceTable;

// The camera's answer to radiance within 7.5-13 um: straight in radiance, 0.01 degC a count for
// black bodies near 25 degC. const functions are thread-safe.
class Radiometer {
 public:
  // The temperature that surfaces mirror where their emissivity is below 1.
  explicit Radiometer(double reflected_degc);

  // Counts of a surface; temperatures are clamped to what a scene may have, -272..1100 degC.
  [[nodiscard]] double counts(double temperature_degc, double emissivity) const;

 private:
  const RadianceTable* table_;
  double reflected_;  // radiances, W m^-2 sr^-1
  double reference_;
  double counts_per_radiance_;
};

// Counts of a black body at 25 degC.
inline constexpr double kCountsAt25DegC = 2500;
inline constexpr double kDegcPerCount = 0.01;

}  // namespace thermedge::sim
