// The typeface of all figures, for Cairo.
#pragma once

#include <cairo.h>

namespace thermedge::figures {

enum class Weight { kRegular, kSemibold };

// Open Sans where fontconfig knows it, else its choice of a sans serif; Cairo draws letters of its
// own where there is no font at all. The caller destroys it. Thread-safe.
[[nodiscard]] cairo_font_face_t* make_font_face(Weight weight);

}  // namespace thermedge::figures
