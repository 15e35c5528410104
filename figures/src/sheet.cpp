#include "sheet.hpp"

#include <algorithm>
#include <cmath>

namespace thermedge::figures {
namespace {

// Sizes of letters and gaps, all from the width of a panel.
struct Typography {
  explicit Typography(double panel_width)
      : unit(panel_width / 100),
        heading{.size = 4.6 * unit, .weight = Weight::kSemibold},
        title{.size = 3.6 * unit, .weight = Weight::kSemibold},
        note{.size = 3.0 * unit, .colour = kSoftInk},
        margin(4 * unit),
        gap(4 * unit) {}

  double unit;
  TextStyle heading, title, note;
  double margin, gap;
  [[nodiscard]] double title_height() const { return 5.4 * unit; }
  [[nodiscard]] double line_height() const { return 4.2 * unit; }
};

struct Cell {
  const Panel* panel;
  std::string letter;
  std::vector<std::string> note_lines;
};

bool has_key(const Panel& panel) { return !panel.legend.empty() || !panel.colour_bars.empty(); }

double text_height(const Cell& cell, const Typography& type) {
  const std::size_t lines = cell.note_lines.size() + (has_key(*cell.panel) ? 1 : 0);
  return static_cast<double>(lines) * type.line_height() + type.unit;
}

void draw_legend(Canvas& canvas, Point at, const Panel& panel, const Typography& type) {
  TextStyle style = type.note;
  style.colour = kInk;
  for (const LegendEntry& entry : panel.legend) {
    const Box swatch = {at.x, at.y - 2.9 * type.unit, 3.6 * type.unit, 3.6 * type.unit};
    canvas.fill(swatch, kInk);
    canvas.mark(entry.mark, {swatch.x + swatch.width / 2, swatch.y + swatch.height / 2},
                2.4 * type.unit, entry.colour);
    canvas.text({swatch.right() + type.unit, at.y}, entry.label, style);
    at.x = swatch.right() + 3.5 * type.unit + canvas.text_width(entry.label, style);
  }
}

void draw_colour_bar(Canvas& canvas, const Box& line, const ColourBar& bar,
                     const Typography& type) {
  TextStyle style = type.note;
  style.colour = kInk;
  const double base = line.y;
  canvas.text({line.x, base}, bar.low, style);
  const double left = line.x + canvas.text_width(bar.low, style) + type.unit;
  const double width = 30 * type.unit;
  constexpr int kSteps = 60;
  for (int i = 0; i < kSteps; ++i) {
    // Neighbours overlap, so that no seam shows.
    canvas.fill(
        {left + width * i / kSteps, base - 2.4 * type.unit, width * 1.5 / kSteps, 2.8 * type.unit},
        bar.colour((i + 0.5) / kSteps));
  }
  canvas.text({left + width * (1 + 0.5 / kSteps) + type.unit, base}, bar.high, style);
}

void draw_cell(Canvas& canvas, const Cell& cell, Point corner, double width, double picture_height,
               const Typography& type) {
  const Panel& panel = *cell.panel;
  double title_x = corner.x;
  const double title_base = corner.y + 3.8 * type.unit;
  if (!cell.letter.empty()) {
    TextStyle letter = type.title;
    letter.colour = kSoftInk;
    letter.weight = Weight::kRegular;
    canvas.text({title_x, title_base}, cell.letter, letter);
    title_x += canvas.text_width(cell.letter, letter) + 1.4 * type.unit;
  }
  canvas.text({title_x, title_base}, panel.title, type.title);
  const Box box = {corner.x, corner.y + type.title_height(), width, width * panel.aspect};
  panel.draw(canvas, box);
  if (panel.bordered) {
    canvas.frame(box, kHairline, 0.15 * type.unit);
  }
  double base = corner.y + type.title_height() + picture_height + type.line_height();
  if (!panel.legend.empty()) {
    draw_legend(canvas, {corner.x, base}, panel, type);
  } else if (!panel.colour_bars.empty()) {
    draw_colour_bar(canvas, {corner.x, base, width, 0}, panel.colour_bars.front(), type);
  }
  base += has_key(panel) ? type.line_height() : 0;
  for (const std::string& line : cell.note_lines) {
    canvas.text({corner.x, base}, line, type.note);
    base += type.line_height();
  }
}

std::vector<Cell> make_cells(std::span<const Panel> panels, bool lettered, double width,
                             const Typography& type) {
  std::vector<Cell> cells;
  // A figure is recorded only for its measure of text.
  const Figure measure(1, 1, [&](Canvas& canvas) {
    for (const Panel& panel : panels) {
      const auto letter = static_cast<char>('a' + cells.size() % 26);
      cells.push_back({&panel, lettered ? std::string{'(', letter, ')'} : std::string{},
                       canvas.wrap(panel.note, width, type.note)});
    }
  });
  return cells;
}

// A row of cells and its heights.
struct Row {
  std::span<const Cell> cells;
  double picture_height = 0;
  double text_height = 0;
};

std::vector<Row> make_rows(std::span<const Cell> cells, int columns, double width,
                           const Typography& type) {
  std::vector<Row> rows;
  while (!cells.empty()) {
    Row row{cells.first(std::min(cells.size(), static_cast<std::size_t>(columns)))};
    for (const Cell& cell : row.cells) {
      row.picture_height = std::max(row.picture_height, width * cell.panel->aspect);
      row.text_height = std::max(row.text_height, text_height(cell, type));
    }
    cells = cells.subspan(row.cells.size());
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

double panel_width_for(int width, double wanted) {
  const double zoom = wanted / width;
  return zoom >= 1 ? width * std::round(zoom) : wanted;
}

Figure make_sheet(const SheetText& text, std::span<const Panel> panels, int columns,
                  double panel_width) {
  const Typography type(panel_width);
  const std::vector<Cell> cells = make_cells(panels, true, panel_width, type);
  const std::vector<Row> rows = make_rows(cells, columns, panel_width, type);
  const double width = 2 * type.margin + columns * panel_width + (columns - 1) * type.gap;
  const double heading_height = 2 * type.title_height() + 1.5 * type.unit;
  double height = 2 * type.margin + heading_height + type.line_height();
  for (const Row& row : rows) {
    height += type.title_height() + row.picture_height + row.text_height + type.gap;
  }
  return Figure(width, height, [&](Canvas& canvas) {
    Point at = {type.margin, type.margin};
    canvas.text({at.x, at.y + 4 * type.unit}, text.title, type.heading);
    canvas.text({at.x, at.y + 9 * type.unit}, text.subtitle, type.note);
    at.y += heading_height;
    for (const Row& row : rows) {
      for (std::size_t i = 0; i < row.cells.size(); ++i) {
        const double x = at.x + static_cast<double>(i) * (panel_width + type.gap);
        draw_cell(canvas, row.cells[i], {x, at.y}, panel_width, row.picture_height, type);
      }
      at.y += type.title_height() + row.picture_height + row.text_height + type.gap;
    }
    canvas.text({at.x, height - type.margin}, text.footer, type.note);
  });
}

Figure make_single(const Panel& panel, double panel_width) {
  const Typography type(panel_width);
  const std::vector<Cell> cells = make_cells({&panel, 1}, false, panel_width, type);
  const double picture_height = panel_width * panel.aspect;
  const double height =
      2 * type.margin + type.title_height() + picture_height + text_height(cells.front(), type);
  return Figure(panel_width + 2 * type.margin, height, [&](Canvas& canvas) {
    draw_cell(canvas, cells.front(), {type.margin, type.margin}, panel_width, picture_height, type);
  });
}

void draw_table(Canvas& canvas, const Box& box, std::span<const TableRow> rows,
                double first_column_share) {
  const Typography type(box.width);
  const double row_height =
      std::min(5.0 * type.unit, box.height / static_cast<double>(rows.size() + 1));
  double base = box.y + row_height;
  for (const TableRow& row : rows) {
    const bool heading = &row == &rows.front();
    TextStyle style = {.size = std::min(3.4 * type.unit, 0.75 * row_height),
                       .colour = heading ? kSoftInk : kInk,
                       .weight = row.strong ? Weight::kSemibold : Weight::kRegular};
    const auto others = static_cast<double>(row.cells.size() - 1);
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const double share =
          i == 0 ? 0
                 : first_column_share + (1 - first_column_share) * static_cast<double>(i) / others;
      style.align = i == 0 ? Align::kLeft : Align::kRight;
      canvas.text({box.x + share * box.width, base}, row.cells[i], style);
    }
    const double rule = base + 0.32 * row_height;
    const Point ends[] = {{box.x, rule}, {box.right(), rule}};
    canvas.line(ends, false, kHairline, (heading ? 0.25 : 0.12) * type.unit);
    base += row_height;
  }
}

}  // namespace thermedge::figures
