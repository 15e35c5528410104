// What figures write, as text: a stand-in for Cairo's function notes each text with its place and
// then lets it be drawn. For one source file of a program.
#pragma once

#include <cairo.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "canvas.hpp"

namespace thermedge::figures {

struct DrawnText {
  std::string text;
  Box box;   // of its ink, points
  Point at;  // left end of its base line
  double size = 0;
  const void* figure = nullptr;  // the surface it was drawn on
};

inline std::vector<DrawnText>& drawn_text() {
  static std::vector<DrawnText> texts;
  return texts;
}

inline void forget_drawn_text() { drawn_text().clear(); }

// Also where `part` was broken into lines.
inline bool is_written(const std::string& part) {
  std::string all;
  for (const DrawnText& drawn : drawn_text()) {
    all += drawn.text + ' ';
  }
  return all.find(part) != std::string::npos;
}

// Nothing is written beyond `sheet` or over another text.
inline void expect_text_in_place(const std::vector<DrawnText>& texts, const Box& sheet) {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Box& a = texts[i].box;
    EXPECT_TRUE(a.x >= sheet.x && a.y >= sheet.y && a.right() <= sheet.right() &&
                a.bottom() <= sheet.bottom())
        << texts[i].text << " leaves the sheet";
    for (std::size_t k = i + 1; k < texts.size(); ++k) {
      const Box& b = texts[k].box;
      const bool apart =
          a.right() <= b.x || b.right() <= a.x || a.bottom() <= b.y || b.bottom() <= a.y;
      EXPECT_TRUE(apart) << texts[i].text << " lies over " << texts[k].text;
    }
  }
}

}  // namespace thermedge::figures

// The program's own function comes before the library's.
extern "C" void cairo_show_text(cairo_t* cairo, const char* text) {
  double x = 0;
  double y = 0;
  cairo_get_current_point(cairo, &x, &y);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text, &extents);
  cairo_user_to_device(cairo, &x, &y);
  cairo_matrix_t font;
  cairo_get_font_matrix(cairo, &font);
  thermedge::figures::drawn_text().push_back(
      {text,
       {x + extents.x_bearing, y + extents.y_bearing, extents.width, extents.height},
       {x, y},
       font.yy,
       cairo_get_target(cairo)});
  using ShowText = void (*)(cairo_t*, const char*);
  reinterpret_cast<ShowText>(dlsym(RTLD_NEXT, "cairo_show_text"))(cairo, text);
}
