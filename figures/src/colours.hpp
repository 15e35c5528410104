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

}  // namespace thermedge::figures
