// Sheets: labelled panels in a grid, with what they show written under each.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "canvas.hpp"
#include "thermedge/figures/figure.hpp"

namespace thermedge::figures {

struct LegendEntry {
  Mark mark = Mark::kDisc;
  Rgb colour;
  std::string label;
};

// A strip of colours with what its ends mean.
struct ColourBar {
  std::function<Rgb(double share)> colour;
  std::string low, high;
};

struct Panel {
  std::string title;
  std::string note;   // the numbers, wrapped under the picture
  double aspect = 1;  // height / width of what `draw` fills
  bool bordered = true;
  std::function<void(Canvas&, const Box&)> draw;
  std::vector<LegendEntry> legend = {};
  std::vector<ColourBar> colour_bars = {};  // none or one
};

struct SheetText {
  std::string title;
  std::string subtitle;
  std::string footer;
};

// Panels row by row in `columns` columns, lettered (a), (b) ...; `panel_width` in points, of which
// all lettering is a fixed share.
[[nodiscard]] Figure make_sheet(const SheetText& text, std::span<const Panel> panels, int columns,
                                double panel_width);

// One panel alone, without a letter.
[[nodiscard]] Figure make_single(const Panel& panel, double panel_width);

// Points for a picture of `width` pixels: near to `wanted`, and a whole number of points a pixel
// where it is enlarged, so that pixels stay squares of one size.
[[nodiscard]] double panel_width_for(int width, double wanted);

struct TableRow {
  std::vector<std::string> cells;  // the first left-aligned, the others right-aligned
  bool strong = false;
};

// Draws rows into the upper part of `box`; the first row is the heading.
void draw_table(Canvas& canvas, const Box& box, std::span<const TableRow> rows,
                double first_column_share);

}  // namespace thermedge::figures
