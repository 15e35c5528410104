#include "canvas.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace thermedge::figures {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;

// A surface that owns a copy of the picture.
cairo_surface_t* to_surface(ImageView<const Rgb> picture) {
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width(), picture.height());
  unsigned char* data = cairo_image_surface_get_data(surface);
  if (data == nullptr) {
    return surface;  // carries Cairo's error
  }
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb pixel = picture(x, y);
      const std::uint32_t packed =
          std::uint32_t{pixel.r} << 16 | std::uint32_t{pixel.g} << 8 | std::uint32_t{pixel.b};
      std::memcpy(data + std::ptrdiff_t{y} * stride + std::ptrdiff_t{4} * x, &packed, 4);
    }
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

}  // namespace

Canvas::Canvas(cairo_surface_t* surface)
    : cairo_(cairo_create(surface)),
      regular_(make_font_face(Weight::kRegular)),
      semibold_(make_font_face(Weight::kSemibold)) {
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
}

Canvas::~Canvas() {
  cairo_destroy(cairo_);
  cairo_font_face_destroy(regular_);
  cairo_font_face_destroy(semibold_);
}

void Canvas::set_colour(Rgb colour) {
  cairo_set_source_rgb(cairo_, colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
}

void Canvas::fill(const Box& box, Rgb colour) {
  set_colour(colour);
  cairo_rectangle(cairo_, box.x, box.y, box.width, box.height);
  cairo_fill(cairo_);
}

void Canvas::frame(const Box& box, Rgb colour, double line_width) {
  set_colour(colour);
  cairo_set_line_width(cairo_, line_width);
  cairo_rectangle(cairo_, box.x, box.y, box.width, box.height);
  cairo_stroke(cairo_);
}

void Canvas::trace(std::span<const Point> points) {
  for (const Point& point : points) {
    cairo_line_to(cairo_, point.x, point.y);
  }
}

void Canvas::line(std::span<const Point> points, bool closed, Rgb colour, double line_width) {
  set_colour(colour);
  cairo_set_line_width(cairo_, line_width);
  trace(points);
  if (closed) {
    cairo_close_path(cairo_);
  }
  cairo_stroke(cairo_);
}

void Canvas::area(std::span<const Point> points, Rgb colour) {
  set_colour(colour);
  trace(points);
  cairo_close_path(cairo_);
  cairo_fill(cairo_);
}

void Canvas::mark(Mark mark, Point at, double size, Rgb colour) {
  const double r = size / 2;
  switch (mark) {
    case Mark::kDisc:
    case Mark::kRing:
      cairo_new_sub_path(cairo_);
      cairo_arc(cairo_, at.x, at.y, r, 0, kFullTurn);
      set_colour(colour);
      if (mark == Mark::kDisc) {
        cairo_fill(cairo_);
      } else {
        cairo_set_line_width(cairo_, size / 4);
        cairo_stroke(cairo_);
      }
      return;
    case Mark::kSquare:
      return fill({at.x - r, at.y - r, size, size}, colour);
    case Mark::kDiamond:
      return area(
          std::array<Point, 4>{
              Point{at.x - r, at.y}, {at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}},
          colour);
    case Mark::kTriangle:
      return area(
          std::array<Point, 3>{Point{at.x - r, at.y + r}, {at.x, at.y - r}, {at.x + r, at.y + r}},
          colour);
  }
}

void Canvas::picture(ImageView<const Rgb> picture, const Box& box) {
  cairo_surface_t* surface = to_surface(picture);
  const double scale_x = box.width / picture.width();
  const double scale_y = box.height / picture.height();
  cairo_save(cairo_);
  cairo_translate(cairo_, box.x, box.y);
  cairo_scale(cairo_, scale_x, scale_y);
  cairo_set_source_surface(cairo_, surface, 0, 0);
  cairo_pattern_t* pattern = cairo_get_source(cairo_);
  cairo_pattern_set_filter(pattern, scale_x < 1 ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  cairo_pattern_set_extend(pattern, CAIRO_EXTEND_PAD);
  cairo_rectangle(cairo_, 0, 0, picture.width(), picture.height());
  cairo_fill(cairo_);
  cairo_restore(cairo_);
  cairo_surface_destroy(surface);
}

void Canvas::set_font(const TextStyle& style) {
  cairo_set_font_face(cairo_, style.weight == Weight::kSemibold ? semibold_ : regular_);
  cairo_set_font_size(cairo_, style.size);
}

void Canvas::text(Point at, std::string_view text, const TextStyle& style) {
  const double width = style.align == Align::kLeft ? 0 : text_width(text, style);
  set_font(style);
  set_colour(style.colour);
  cairo_move_to(cairo_, at.x - (style.align == Align::kCentre ? width / 2 : width), at.y);
  cairo_show_text(cairo_, std::string(text).c_str());
  cairo_new_path(cairo_);  // forgets the end of the text, where the next line would begin
}

double Canvas::text_width(std::string_view text, const TextStyle& style) {
  set_font(style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, std::string(text).c_str(), &extents);
  return extents.x_advance;
}

std::vector<std::string> Canvas::wrap(std::string_view text, double width, const TextStyle& style) {
  std::vector<std::string> lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string longer = line.empty() ? std::string(text.substr(0, end))
                                            : line + ' ' + std::string(text.substr(0, end));
    if (!line.empty() && text_width(longer, style) > width) {
      lines.push_back(line);
      line = text.substr(0, end);
    } else {
      line = longer;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (!line.empty()) {
    lines.push_back(line);
  }
  return lines;
}

void Canvas::inside_frame(const Box& box, int width, int height,
                          const std::function<void()>& draw) {
  cairo_save(cairo_);
  cairo_rectangle(cairo_, box.x, box.y, box.width, box.height);
  cairo_clip(cairo_);
  cairo_translate(cairo_, box.x, box.y);
  cairo_scale(cairo_, box.width / width, box.height / height);
  cairo_translate(cairo_, 0.5, 0.5);
  draw();
  cairo_restore(cairo_);
}

}  // namespace thermedge::figures
