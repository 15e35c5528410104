// The drawing surface of figures: boxes, lines, marks, pictures, text. Lengths are in points, x
// right, y down, except inside Canvas::inside_frame.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "colours.hpp"
#include "thermedge/image.hpp"
#include "typeface.hpp"

namespace thermedge::figures {

struct Point {
  double x = 0, y = 0;
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] double right() const { return x + width; }
  [[nodiscard]] double bottom() const { return y + height; }
  [[nodiscard]] Box inset(double margin) const {
    return {x + margin, y + margin, width - 2 * margin, height - 2 * margin};
  }
};

enum class Align { kLeft, kCentre, kRight };

struct TextStyle {
  double size = 12;  // of an em
  Rgb colour = kInk;
  Weight weight = Weight::kRegular;
  Align align = Align::kLeft;
};

enum class Mark { kDisc, kRing, kSquare, kDiamond, kTriangle };

// Draws on a surface of Cairo. One thread at a time.
class Canvas {
 public:
  // Keeps a reference to `surface`.
  explicit Canvas(cairo_surface_t* surface);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas();

  void fill(const Box& box, Rgb colour);
  void frame(const Box& box, Rgb colour, double line_width);
  void line(std::span<const Point> points, bool closed, Rgb colour, double line_width);
  // Fills what lies between the points, as a polygon.
  void area(std::span<const Point> points, Rgb colour);
  void mark(Mark mark, Point at, double size, Rgb colour);

  // Stretched over `box` with hard pixel borders (smooth where it is made smaller).
  void picture(ImageView<const Rgb> picture, const Box& box);

  // `at`: left end, middle or right end of the base line.
  void text(Point at, std::string_view text, const TextStyle& style);
  [[nodiscard]] double text_width(std::string_view text, const TextStyle& style);
  // Lines of at most `width`, broken between words.
  [[nodiscard]] std::vector<std::string> wrap(std::string_view text, double width,
                                              const TextStyle& style);

  // Runs `draw` with the coordinates of a frame of `width` x `height` pixels spread over `box`
  // (pixel centres at integers) and clipped to it. Line widths and marks are then in pixels.
  void inside_frame(const Box& box, int width, int height, const std::function<void()>& draw);

 private:
  void set_colour(Rgb colour);
  void set_font(const TextStyle& style);
  void trace(std::span<const Point> points);

  cairo_t* cairo_;
  cairo_font_face_t* regular_;
  cairo_font_face_t* semibold_;
};

}  // namespace thermedge::figures
