#include "typeface.hpp"

#include <cairo-ft.h>

#include <memory>

extern "C" {
extern const unsigned char thermedge_typeface_regular[];
extern const unsigned char thermedge_typeface_regular_end[];
extern const unsigned char thermedge_typeface_semibold[];
extern const unsigned char thermedge_typeface_semibold_end[];
}

namespace thermedge::figures {
namespace {

// FreeType's library and the face made from it go together; one pair per font face, so that faces
// on different threads share nothing.
struct FreeTypeFace {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  FreeTypeFace() = default;
  FreeTypeFace(const FreeTypeFace&) = delete;
  FreeTypeFace& operator=(const FreeTypeFace&) = delete;
  ~FreeTypeFace() {
    if (face != nullptr) {
      FT_Done_Face(face);
    }
    if (library != nullptr) {
      FT_Done_FreeType(library);
    }
  }
};

void destroy_face(void* face) { delete static_cast<FreeTypeFace*>(face); }

constexpr cairo_user_data_key_t kFaceKey{};

}  // namespace

cairo_font_face_t* make_font_face(Weight weight) {
  const bool bold = weight == Weight::kSemibold;
  const unsigned char* first = bold ? thermedge_typeface_semibold : thermedge_typeface_regular;
  const unsigned char* last =
      bold ? thermedge_typeface_semibold_end : thermedge_typeface_regular_end;
  auto held = std::make_unique<FreeTypeFace>();
  if (FT_Init_FreeType(&held->library) != 0 ||
      FT_New_Memory_Face(held->library, first, last - first, 0, &held->face) != 0) {
    return nullptr;
  }
  cairo_font_face_t* font = cairo_ft_font_face_create_for_ft_face(held->face, FT_LOAD_NO_HINTING);
  if (cairo_font_face_set_user_data(font, &kFaceKey, held.get(), destroy_face) !=
      CAIRO_STATUS_SUCCESS) {
    cairo_font_face_destroy(font);
    return nullptr;
  }
  static_cast<void>(held.release());  // Cairo destroys it with the font
  return font;
}

}  // namespace thermedge::figures
