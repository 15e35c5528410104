// Colours that suit colour-blind eyes and keep their order when printed in grey.
#pragma once

#include <cstddef>

#include "thermedge/io/write.hpp"

namespace thermedge::figures {

using io::Rgb;

inline constexpr Rgb kPaper = {255, 255, 255};
inline constexpr Rgb kInk = {28, 30, 34};
inline constexpr Rgb kSoftInk = {95, 99, 106};
inline constexpr Rgb kHairline = {200, 203, 208};

// The colours of Okabe and Ito (2008) that stand out of a dark picture, for things that only have
// to be told apart. Any index.
[[nodiscard]] Rgb category_colour(std::size_t index);

// Cividis-like ramp for quantities: dark blue (0) over grey to yellow (1), lightness rising
// steadily (after Nunez, Anderton, Renslow 2018). Shares are clamped.
[[nodiscard]] Rgb quantity_colour(double share);

// Diverging ramp: blue (-1) over white (0) to orange (1).
[[nodiscard]] Rgb diverging_colour(double share);

}  // namespace thermedge::figures
