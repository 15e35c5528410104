// Files of figures: PNG, SVG and PDF that other programs can read, of the figure's size.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "raster.hpp"
#include "support/files.hpp"

namespace thermedge::figures {
namespace {

using test::file_text;
using test::TemporaryDirectory;

void draw_everything(Canvas& canvas) {
  Image<Rgb> pixels(3, 2);
  fill_pixels(pixels.view(), Rgb{9, 120, 200});
  const Point line[] = {{5, 5}, {90, 45}};
  canvas.picture(pixels.view(), {10, 10, 30, 20});
  canvas.line(line, false, kInk, 1);
  canvas.mark(Mark::kRing, {70, 20}, 10, kSoftInk);
  canvas.text({20, 40}, "5 < 6 & 7 > 2", {.size = 8});
}

// Every element is closed in the order of nesting, quotes and ampersands are in order; enough to
// tell that a reader of XML will not stop. Counts the elements of each name.
struct Xml {
  bool well_formed = false;
  std::vector<std::string> elements;
  [[nodiscard]] long count(const std::string& name) const {
    return std::count(elements.begin(), elements.end(), name);
  }
};

Xml read_xml(const std::string& text) {
  Xml xml;
  std::vector<std::string> open;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) {
      return xml;
    }
    const std::string tag = text.substr(at + 1, end - at - 1);
    at = end;
    if (tag.starts_with('?') || tag.starts_with('!')) {
      continue;
    }
    const bool closes = tag.starts_with('/');
    const std::size_t start = closes ? 1 : 0;
    const std::string name = tag.substr(start, tag.find_first_of(" \n/", start) - start);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) {
      return xml;
    }
    if (closes) {
      if (open.empty() || open.back() != name) {
        return xml;
      }
      open.pop_back();
      continue;
    }
    xml.elements.push_back(name);
    if (!tag.ends_with('/')) {
      open.push_back(name);
    }
  }
  xml.well_formed = open.empty() && !xml.elements.empty();
  return xml;
}

TEST(FigureFiles, PngHasOnePixelAPoint) {
  const TemporaryDirectory directory;
  const Figure figure(99.2, 50, draw_everything);
  ASSERT_TRUE(figure.write(directory / "x.png"));
  const std::string bytes = file_text(directory / "x.png");
  ASSERT_GT(bytes.size(), 24U);
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
  };
  EXPECT_EQ(number(16), 100) << "a part of a point is a whole pixel";
  EXPECT_EQ(number(20), 50);
}

TEST(FigureFiles, SvgIsWellFormedAndKeepsVectors) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(Figure(100, 50, draw_everything).write(directory / "x.svg"));
  const std::string text = file_text(directory / "x.svg");
  const Xml xml = read_xml(text);
  EXPECT_TRUE(xml.well_formed) << text.substr(0, 2000);
  ASSERT_FALSE(xml.elements.empty());
  EXPECT_EQ(xml.elements.front(), "svg");
  EXPECT_EQ(xml.count("svg"), 1);
  EXPECT_EQ(xml.count("image"), 1) << "of the picture alone";
  EXPECT_GE(xml.count("path"), 2) << "the line and the ring";
  EXPECT_NE(text.find("viewBox=\"0 0 100 50\""), std::string::npos) << text.substr(0, 400);
  EXPECT_FALSE(read_xml(text.substr(0, text.size() - 9)).well_formed);
}

TEST(FigureFiles, PdfIsOnePageOfAQuarterOfTheSize) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(Figure(400, 200, draw_everything).write(directory / "x.pdf"));
  const std::string bytes = file_text(directory / "x.pdf");
  EXPECT_NE(bytes.find("/Count 1"), std::string::npos);
  EXPECT_NE(bytes.find("/MediaBox [ 0 0 100 50 ]"), std::string::npos);
  EXPECT_NE(bytes.find("/FontDescriptor"), std::string::npos) << "text stays text";
  EXPECT_NE(bytes.rfind("%%EOF"), std::string::npos);
}

TEST(FigureFiles, AFileThatIsThereIsReplacedAsAWhole) {
  const TemporaryDirectory directory;
  for (const std::string ending : {"png", "svg", "pdf"}) {
    const std::string path = directory / ("x." + ending);
    test::write_text(path, std::string(1 << 20, 'x'));
    ASSERT_TRUE(Figure(100, 50, draw_everything).write(path));
    EXPECT_LT(std::filesystem::file_size(path), 1U << 19);
  }
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory.path())) {
    ++files;
  }
  EXPECT_EQ(files, 3U) << "nothing is left beside them";
}

TEST(FigureFiles, EndingsAreKnown) {
  for (const char* path : {"a.png", "dir/b.svg", "c.d.pdf", ".x.png", "a.PNG"}) {
    EXPECT_TRUE(is_figure_path(path)) << path;
  }
  for (const char* path : {"", "png", ".png", "a.png/", "a.jpg", "a.png.txt", "svg"}) {
    EXPECT_FALSE(is_figure_path(path)) << path;
  }
}

TEST(FigureFiles, AFigureMovesWithItsDrawing) {
  Figure figure(100, 50, draw_everything);
  const auto before = rasterised(figure);
  Figure other(10, 10, [](Canvas&) {});
  other = std::move(figure);
  const auto after = rasterised(other);
  ASSERT_EQ(after.width(), 100);
  EXPECT_EQ(other.height(), 50);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 100; ++x) {
      ASSERT_EQ(after(x, y), before(x, y)) << x << ", " << y;
    }
  }
}

TEST(FigureFiles, PaperIsWhiteToItsLastPixel) {
  const auto picture = drawn(7, 5, [](Canvas&) {});
  EXPECT_EQ(extent_of(picture, kPaper).pixels, 7 * 5);
}

}  // namespace
}  // namespace thermedge::figures
