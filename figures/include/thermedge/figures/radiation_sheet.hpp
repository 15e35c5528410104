// Thermal radiation of black bodies: the paper's figure 2.
#pragma once

#include <span>

#include "thermedge/figures/figure.hpp"
#include "thermedge/radiometry/planck.hpp"
#include "thermedge/result.hpp"

namespace thermedge::figures {

inline constexpr double kLowestKelvin = 100;
inline constexpr double kHighestKelvin = 10000;

// Planck's curves (eq. 1) of bodies of these temperatures, with their maxima by Wien's displacement
// law (eq. 2) and the camera's band, beside those of glowing bodies. Errors: no temperature or more
// than 8, one outside of kLowestKelvin .. kHighestKelvin, a band that is empty or negative.
[[nodiscard]] Result<Figure> draw_radiation(std::span<const double> temperatures_k,
                                            const Band& band = {},
                                            double panel_width = kPanelWidth);

}  // namespace thermedge::figures
