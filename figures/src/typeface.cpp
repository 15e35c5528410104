#include "typeface.hpp"

#include <cairo-ft.h>
#include <fontconfig/fontconfig.h>

namespace thermedge::figures {

cairo_font_face_t* make_font_face(Weight weight) {
  const int wanted = weight == Weight::kSemibold ? FC_WEIGHT_DEMIBOLD : FC_WEIGHT_REGULAR;
  // Everything that shapes the letters is said here, so that a user's settings for screens do not
  // show in figures.
  FcPattern* pattern = FcPatternBuild(
      nullptr, FC_FAMILY, FcTypeString, "Open Sans", FC_FAMILY, FcTypeString, "sans-serif",
      FC_WEIGHT, FcTypeInteger, wanted, FC_HINTING, FcTypeBool, FcFalse, FC_AUTOHINT, FcTypeBool,
      FcFalse, FC_ANTIALIAS, FcTypeBool, FcTrue, FC_RGBA, FcTypeInteger, FC_RGBA_NONE, nullptr);
  cairo_font_face_t* font = cairo_ft_font_face_create_for_pattern(pattern);
  FcPatternDestroy(pattern);
  return font;
}

}  // namespace thermedge::figures
