// The typeface of all figures, for Cairo.
#pragma once

#include <cairo.h>

namespace thermedge::figures {

enum class Weight { kRegular, kSemibold };

// A font face that the caller destroys; null where FreeType refuses it. Thread-safe.
[[nodiscard]] cairo_font_face_t* make_font_face(Weight weight);

}  // namespace thermedge::figures
