// Sheets and tables: everything has its place, whatever is put on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "drawn_text.hpp"
#include "raster.hpp"
#include "sheet.hpp"

namespace thermedge::figures {
namespace {

constexpr Rgb kRed = {200, 10, 20};
constexpr double kWidth = 400;

Panel filled(double aspect, std::string note, std::vector<Box>& boxes) {
  return {.title = "Panel",
          .note = std::move(note),
          .aspect = aspect,
          .draw = [&boxes](Canvas& canvas, const Box& box) {
            boxes.push_back(box);
            canvas.fill(box, kRed);
          }};
}

Box whole(const Figure& figure) { return {0, 0, figure.width(), figure.height()}; }

struct Grid {
  int panels, columns;
  int rows, widest;  // panels of the widest row
};

// No picture or text lies over another one, and the sheet is as wide as its columns.
TEST(Layout, PanelsLieInAGridWithoutOverlaps) {
  const std::string notes[] = {"short",
                               "a note of many words that needs more than one line under its "
                               "picture, and says something at length about what is seen"};
  for (const Grid& grid :
       {Grid{1, 1, 1, 1}, {1, 4, 1, 1}, {4, 4, 1, 4}, {5, 4, 2, 4}, {9, 2, 5, 2}, {28, 5, 6, 5}}) {
    SCOPED_TRACE(grid.panels);
    std::vector<Panel> panels;
    std::vector<Box> boxes;
    for (int i = 0; i < grid.panels; ++i) {
      const std::string& note = notes[i % 2];
      panels.push_back(filled(i % 3 == 0 ? 0.4 : 0.75, note, boxes));
    }
    forget_drawn_text();
    const Figure sheet = make_sheet({"Title", "subtitle", "footer"}, panels, grid.columns, kWidth);
    ASSERT_EQ(boxes.size(), panels.size());
    EXPECT_NEAR(sheet.width(), 32 + grid.columns * kWidth + (grid.columns - 1) * 16, 1);
    std::vector<DrawnText> placed = drawn_text();
    for (const Box& box : boxes) {
      placed.push_back({"picture", box.inset(0.01), {}});
    }
    expect_text_in_place(placed, whole(sheet));
    EXPECT_DOUBLE_EQ(boxes.front().x, 16);
    std::set<double> tops;
    for (const Box& box : boxes) {
      tops.insert(box.y);
    }
    EXPECT_EQ(tops.size(), static_cast<std::size_t>(grid.rows));
  }
}

TEST(Layout, PanelsAreLetteredInOrder) {
  std::vector<Panel> panels;
  std::vector<Box> boxes;
  panels.reserve(28);
  for (int i = 0; i < 28; ++i) {
    panels.push_back(filled(0.5, "", boxes));
  }
  forget_drawn_text();
  (void)make_sheet({"Title", "subtitle", "footer"}, panels, 7, 100);
  std::string letters;
  for (const DrawnText& drawn : drawn_text()) {
    if (drawn.text.size() == 3 && drawn.text[0] == '(') {
      letters += drawn.text[1];
    }
  }
  EXPECT_EQ(letters, "abcdefghijklmnopqrstuvwxyzab");
}

TEST(Layout, APanelAloneHasNoLetterAndNoHeading) {
  std::vector<Box> boxes;
  forget_drawn_text();
  const Figure figure = make_single(filled(0.5, "its note", boxes), kWidth);
  ASSERT_EQ(drawn_text().size(), 2U);
  EXPECT_EQ(drawn_text()[0].text, "Panel");
  EXPECT_EQ(drawn_text()[1].text, "its note");
  EXPECT_EQ(figure.width(), kWidth + 32);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_EQ(boxes[0].width, kWidth);
  EXPECT_EQ(boxes[0].height, kWidth / 2);
  EXPECT_GT(drawn_text()[1].box.y, boxes[0].bottom());
  expect_text_in_place(drawn_text(), whole(figure));
}

// A row is as high as its highest picture and its longest note; the next row begins under both.
TEST(Layout, RowsMakeRoomForLongNotesAndHighPictures) {
  std::vector<Box> boxes;
  std::string words;
  for (int i = 0; i < 60; ++i) {
    words += "word ";
  }
  const std::vector<Panel> panels = {filled(0.3, words, boxes), filled(1.2, "short", boxes),
                                     filled(0.3, "", boxes)};
  forget_drawn_text();
  (void)make_sheet({"T", "s", "f"}, panels, 2, kWidth);
  ASSERT_EQ(boxes.size(), 3U);
  EXPECT_EQ(boxes[0].y, boxes[1].y);
  double lowest = 0;
  int lines = 0;
  for (const DrawnText& drawn : drawn_text()) {
    if (drawn.text.starts_with("word")) {
      lowest = std::max(lowest, drawn.box.bottom());
      EXPECT_GE(drawn.box.y, boxes[1].bottom()) << "notes begin on one line under all pictures";
      EXPECT_LE(drawn.box.width, kWidth);
      ++lines;
    }
  }
  EXPECT_GE(lines, 3);
  EXPECT_GT(boxes[2].y, lowest);
}

TEST(Layout, LetteringIsAFixedShareOfThePanel) {
  std::vector<Box> boxes;
  const std::vector<Panel> panels = {filled(0.5, "note", boxes)};
  std::vector<double> sizes[2];
  for (const int scale : {1, 2}) {
    forget_drawn_text();
    (void)make_sheet({"Title", "subtitle", "footer"}, panels, 1, scale * kWidth);
    for (const DrawnText& drawn : drawn_text()) {
      sizes[scale - 1].push_back(drawn.size / scale);
    }
  }
  ASSERT_EQ(sizes[0].size(), 6U);
  for (std::size_t i = 0; i < sizes[0].size(); ++i) {
    EXPECT_DOUBLE_EQ(sizes[0][i], sizes[1][i]);
  }
  EXPECT_EQ(sizes[0].front(), *std::max_element(sizes[0].begin(), sizes[0].end())) << "the title";
}

TEST(Layout, BordersAreDrawnWhereWanted) {
  for (const bool bordered : {false, true}) {
    Box place;
    const Panel panel = {.title = "",
                         .note = "",
                         .aspect = 0.5,
                         .bordered = bordered,
                         .draw = [&place](Canvas&, const Box& box) { place = box; }};
    const auto picture = rasterised(make_single(panel, 1000));
    const Rgb side = picture(static_cast<int>(place.x), static_cast<int>(place.y) + 250);
    EXPECT_EQ(side != kPaper, bordered);
    EXPECT_EQ(picture(static_cast<int>(place.x) + 500, static_cast<int>(place.y) + 250), kPaper);
  }
}

TEST(Legend, ShowsEveryMarkBesideItsWord) {
  std::vector<Box> boxes;
  Panel panel = filled(0.5, "note", boxes);
  panel.legend = {{Mark::kDisc, {1, 160, 3}, "one"},
                  {Mark::kSquare, {0, 90, 240}, "another"},
                  {Mark::kTriangle, {240, 230, 0}, "third"}};
  forget_drawn_text();
  const Figure figure = make_single(panel, 1000);
  const auto picture = rasterised(figure);
  expect_text_in_place(drawn_text(), whole(figure));
  double before = 0;
  for (const LegendEntry& entry : panel.legend) {
    const auto text = std::find_if(drawn_text().begin(), drawn_text().end(),
                                   [&](const DrawnText& t) { return t.text == entry.label; });
    ASSERT_NE(text, drawn_text().end()) << entry.label;
    const Extent mark = extent_of(picture, entry.colour);
    EXPECT_GT(mark.pixels, 100);
    EXPECT_GT(mark.left, before);
    EXPECT_LT(mark.right, text->box.x);
    EXPECT_GT(text->box.bottom(), mark.top);
    EXPECT_LT(text->box.y, mark.bottom);
    before = text->box.right();
  }
  EXPECT_EQ(drawn_text().back().text, "note");
  const double below = figure.height() - drawn_text().back().at.y;
  EXPECT_GT(drawn_text().back().box.y, drawn_text()[1].box.bottom()) << "the note comes after it";
  panel.legend.clear();
  const Figure without = make_single(panel, 1000);
  EXPECT_EQ(without.height() - drawn_text().back().at.y, below) << "its line has room of its own";
}

TEST(ColourBar, RunsFromItsLowToItsHighEnd) {
  std::vector<Box> boxes;
  Panel panel = filled(0.5, "", boxes);
  panel.colour_bars = {{[](double share) {
                          return Rgb{0, static_cast<std::uint8_t>(255 * share), 255};
                        },
                        "0.1", "9.5 counts"}};
  forget_drawn_text();
  const Figure figure = make_single(panel, 1000);
  const auto picture = rasterised(figure);
  ASSERT_EQ(drawn_text().size(), 3U);
  const DrawnText& low = drawn_text()[1];
  const DrawnText& high = drawn_text()[2];
  EXPECT_EQ(low.text, "0.1");
  EXPECT_EQ(high.text, "9.5 counts");
  const auto is_bar = [](Rgb pixel) { return pixel.r == 0 && pixel.b == 255; };
  const Extent bar = extent_of(picture, is_bar);
  EXPECT_GT(bar.left, low.box.right());
  EXPECT_LT(bar.right, high.box.x);
  EXPECT_NEAR(bar.width(), 300, 6);
  const int y = (bar.top + bar.bottom) / 2;
  for (int x = bar.left + 1; x < bar.right - 1; ++x) {
    ASSERT_TRUE(is_bar(picture(x, y))) << "a seam at " << x;
    EXPECT_GE(picture(x, y).g, picture(x - 1, y).g);
  }
  EXPECT_LT(picture(bar.left + 2, y).g, 10);
  EXPECT_GT(picture(bar.right - 2, y).g, 245);
}

struct TableCase {
  std::size_t rows;
  Box box;
};

TEST(Table, CellsKeepToTheirColumnsAndTheBox) {
  for (const TableCase& table : {TableCase{2, {10, 20, 600, 450}},
                                 {7, {10, 20, 600, 450}},
                                 {14, {10, 20, 600, 450}},
                                 {30, {0, 0, 300, 100}}}) {
    SCOPED_TRACE(table.rows);
    std::vector<TableRow> rows = {{{"step", "count", "ms"}, false}};
    for (std::size_t i = 1; i < table.rows; ++i) {
      rows.push_back({{"edge_pixels", "100", std::to_string(1000 * i) + ".25"}, i % 2 == 0});
    }
    forget_drawn_text();
    const Figure figure(700, 600,
                        [&](Canvas& canvas) { draw_table(canvas, table.box, rows, 0.4); });
    const auto& texts = drawn_text();
    ASSERT_EQ(texts.size(), 3 * table.rows);
    expect_text_in_place(texts, table.box.inset(-1));
    for (std::size_t i = 0; i < texts.size(); ++i) {
      EXPECT_EQ(texts[i].text, rows[i / 3].cells[i % 3]);
      const Box& cell = texts[i].box;
      EXPECT_TRUE(i < 3 || cell.y > texts[i - 3].box.y);
      if (i % 3 == 0) {
        EXPECT_NEAR(cell.x, table.box.x, 3) << "names are aligned on the left";
      } else {
        const double share = i % 3 == 1 ? 0.7 : 1;
        EXPECT_NEAR(cell.right(), table.box.x + share * table.box.width, 3) << "numbers, right";
      }
    }
  }
}

}  // namespace
}  // namespace thermedge::figures
