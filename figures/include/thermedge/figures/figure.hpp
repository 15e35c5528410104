// A drawing: text, lines and pictures, to be written as PNG, SVG or PDF.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "thermedge/image.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/result.hpp"

namespace thermedge::figures {

// Width of a panel of a sheet, points, where nothing else is asked for; all lettering is a fixed
// share of it.
inline constexpr double kPanelWidth = 760;

class Canvas;  // what a figure is drawn with; see figures/src/canvas.hpp

// Holds a drawing as it was made, independent of resolution. Move-only. One thread at a time.
class Figure {
 public:
  // Records what `draw` draws on `width` x `height` points (rounded up), on white paper.
  Figure(double width, double height, const std::function<void(Canvas&)>& draw);
  Figure(Figure&&) noexcept;
  Figure& operator=(Figure&&) noexcept;
  ~Figure();

  [[nodiscard]] double width() const { return width_; }    // points
  [[nodiscard]] double height() const { return height_; }  // points

  // One pixel a point. Errors: a figure too large for Cairo (32767 points a side).
  [[nodiscard]] Result<Image<io::Rgb>> rasterise() const;

  // The format is what the ending of `path` names: .png (one pixel a point), .svg or .pdf (text and
  // lines as vectors, pictures as pixels). Whole or not at all. Errors: another ending, too large,
  // the file cannot be written.
  [[nodiscard]] Status write(const std::string& path) const;

 private:
  struct Recording;
  std::unique_ptr<Recording> recording_;
  double width_;
  double height_;
};

// Whether Figure::write knows the ending of `path`.
[[nodiscard]] bool is_figure_path(std::string_view path);

}  // namespace thermedge::figures
