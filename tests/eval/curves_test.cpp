// Positions, recall over contrast and repeatability on curves whose figures are known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "thermedge/eval/curves.hpp"

namespace thermedge::eval {
namespace {

Curve line(Point from, Point to, double contrast_counts = 50) {
  Curve curve;
  constexpr int kParts = 40;
  for (int i = 0; i <= kParts; ++i) {
    const double t = static_cast<double>(i) / kParts;
    curve.points.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
  curve.contrast_counts = contrast_counts;
  return curve;
}

CurveFrame frame_of(std::vector<Curve> curves) {
  CurveFrame frame;
  frame.width = 100;
  frame.height = 80;
  frame.curves = std::move(curves);
  return frame;
}

Curve circle(Point centre, double radius_px) {
  Curve curve;
  curve.closed = true;
  constexpr int kParts = 400;
  for (int i = 0; i < kParts; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / kParts;
    curve.points.push_back(
        {centre.x + radius_px * std::cos(angle), centre.y + radius_px * std::sin(angle)});
  }
  return curve;
}

TEST(Localisation, OffsetsAreSignedAndAlongTheNormal) {
  // Walking right, the right hand side is below.
  const auto truth = frame_of({line({10, 20}, {50, 20})});
  const auto below = localise(frame_of({line({15, 20.25}, {45, 20.25})}), truth, 3);
  EXPECT_EQ(below.points, 41);
  EXPECT_NEAR(below.mean_px(), 0.25, 1e-12);
  EXPECT_NEAR(below.rms_px(), 0.25, 1e-12);
  const auto above = localise(frame_of({line({45, 19.5}, {15, 19.5})}), truth, 3);
  EXPECT_NEAR(above.mean_px(), -0.5, 1e-12);
  const auto both =
      localise(frame_of({line({15, 20.3}, {45, 20.3}), line({15, 19.7}, {45, 19.7})}), truth, 3);
  EXPECT_NEAR(both.mean_px(), 0, 1e-12);
  EXPECT_NEAR(both.rms_px(), 0.3, 1e-12);
  // A slanted edge: the offset along x is larger than the one along the normal.
  const auto slanted =
      localise(frame_of({line({21, 20}, {41, 40})}), frame_of({line({10, 10}, {60, 60})}), 3);
  EXPECT_NEAR(slanted.rms_px(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(slanted.mean_px(), -std::sqrt(0.5), 1e-12);
}

TEST(Localisation, OfACircleIsTheDifferenceOfTheRadii) {
  const auto truth = frame_of({circle({50, 40}, 20)});
  for (const double radius_px : {19.6, 20.4}) {
    const auto result = localise(frame_of({circle({50, 40}, radius_px)}), truth, 3);
    EXPECT_EQ(result.points, 400);
    // With y down, rising angles walk clockwise and the centre lies to the right.
    EXPECT_NEAR(result.mean_px(), 20 - radius_px, 1e-2);
    EXPECT_NEAR(result.rms_px(), 0.4, 1e-2);
  }
}

TEST(Localisation, LeavesOutWhatIsFarOrBeyondAnEnd) {
  const auto truth = frame_of({line({10, 20}, {50, 20})});
  EXPECT_EQ(localise(frame_of({line({10, 24}, {50, 24})}), truth, 3).points, 0);
  EXPECT_TRUE(std::isnan(localise(frame_of({}), truth, 3).rms_px()));
  EXPECT_TRUE(std::isnan(localise(truth, frame_of({}), 3).mean_px()));
  // 41 points from 40 to 60: those up to 50 lie beside the truth.
  const auto result = localise(frame_of({line({40, 20}, {60, 20})}), truth, 3);
  EXPECT_EQ(result.points, 21);
  EXPECT_NEAR(result.rms_px(), 0, 1e-12);
  EXPECT_EQ(localise(frame_of({line({0, 20}, {20, 20})}), truth, 3).points, 21);
}

// The grid of cells finds what a look at every part finds.
TEST(NearestOnCurves, AgreesWithLookingAtEverything) {
  std::mt19937 random(5);
  const auto coordinate = [&](int size) {
    return static_cast<double>(random() % static_cast<unsigned>(100 * size)) / 100 - 5;
  };
  std::vector<Curve> curves;
  for (int i = 0; i < 12; ++i) {
    Curve curve;
    for (int k = 0; k < 5; ++k) {
      curve.points.push_back({coordinate(110), coordinate(90)});
    }
    curve.closed = i % 3 == 0;
    curves.push_back(curve);
  }
  const double reach_px = 6;
  const NearestOnCurves index(curves, reach_px);
  const NearestOnCurves everything(curves, 1e4);  // one cell
  int near = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point point{coordinate(120), coordinate(100)};
    const auto place = index.nearest(point);
    const auto expected = everything.nearest(point);
    ASSERT_EQ(index.is_near(point), expected.distance_px <= reach_px);
    if (expected.distance_px <= reach_px) {
      ++near;
      ASSERT_EQ(place.distance_px, expected.distance_px);
      ASSERT_EQ(place.offset_px, expected.offset_px);
      ASSERT_EQ(place.beside, expected.beside);
    }
  }
  EXPECT_GT(near, 500);
}

TEST(NearestOnCurves, TakesNoMemoryForWhatIsFarAway) {
  const Curve far_apart = line({-1e5, -1e5}, {1e5, 1e5});
  const std::vector<Curve> curves{far_apart, line({10, 20}, {50, 20})};
  const NearestOnCurves index(curves, 3);
  EXPECT_NEAR(index.nearest({30, 21}).offset_px, 1, 1e-9);
  EXPECT_NEAR(index.nearest({70000, 70002}).distance_px, std::sqrt(2.0), 1e-6);
  EXPECT_FALSE(index.is_near({70000, 70005}));
}

TEST(ContrastRecall, IsTheShareOfTheLengthThatWasFound) {
  const auto truth = frame_of({line({0, 10}, {40, 10}, 4), line({0, 30}, {40, 30}, 20),
                               line({0, 50}, {40, 50}, 39.9), line({0, 70}, {40, 70}, 1000),
                               line({50, 10}, {90, 10}, std::nan(""))});
  // All of the second edge, half of the third, in reach by 0.5 px at the end.
  const auto found = frame_of({line({0, 31}, {40, 31}), line({0, 50}, {19, 50})});
  ContrastRecall recall({2, 10, 20, 40});
  recall.add(found, truth, 1, 1);
  EXPECT_EQ(recall.true_px.size(), 4U);
  EXPECT_NEAR(recall.true_px[0], 40, 1e-9);
  EXPECT_NEAR(recall.true_px[1], 0, 1e-9);
  EXPECT_NEAR(recall.true_px[2], 80, 1e-9);
  EXPECT_NEAR(recall.true_px[3], 40, 1e-9);
  EXPECT_NEAR(recall.found_px[0], 0, 1e-9);
  EXPECT_NEAR(recall.found_px[2], 60, 0.26);
  EXPECT_NEAR(recall.found_px[3], 0, 1e-9);

  ContrastRecall in_sigma({2, 10, 20, 40});
  in_sigma.add(found, truth, 1, 10);
  EXPECT_NEAR(in_sigma.true_px[0], 80, 1e-9);  // 2 and 3.99 sigma
  EXPECT_NEAR(in_sigma.true_px[3], 40, 1e-9);  // 100 sigma
  in_sigma += in_sigma;
  EXPECT_NEAR(in_sigma.true_px[3], 80, 1e-9);
}

TEST(Repeatability, FollowsTheMotion) {
  const auto before = frame_of({circle({40, 40}, 20), line({5, 5}, {8, 70})});
  // A quarter turn about (40, 40), and a shift.
  const auto motion = [](Point p) { return Point{40 - (p.y - 40) + 3, 40 + (p.x - 40) - 6}; };
  auto after = before;
  for (Curve& curve : after.curves) {
    for (Point& point : curve.points) {
      point = motion(point);
    }
  }
  // Part of the line leaves the frame: those points don't count.
  const auto moved = repeatability(before, after, motion);
  EXPECT_EQ(moved.share(), 1.0);
  EXPECT_LT(moved.points, 441);
  EXPECT_GT(moved.points, 400);
  const auto still = repeatability(before, after, [](Point p) { return p; });
  EXPECT_LT(still.share(), 0.5);
  EXPECT_TRUE(std::isnan(repeatability(frame_of({}), after, motion).share()));
}

TEST(Repeatability, FindsTheShift) {
  const auto before = frame_of({circle({40, 40}, 20), line({20, 5}, {60, 9})});
  for (const auto& [dx, dy] : {std::pair{0, 0}, {3, -2}, {-4, 4}}) {
    auto after = before;
    for (Curve& curve : after.curves) {
      for (Point& point : curve.points) {
        point = {point.x + dx + 0.2, point.y + dy - 0.1};
      }
    }
    const auto result = best_shift(before, after, 4, 0.3);
    EXPECT_EQ(result.dx, dx);
    EXPECT_EQ(result.dy, dy);
    EXPECT_EQ(result.repeatability.share(), 1.0);
  }
  EXPECT_EQ(best_shift(before, frame_of({}), 4).dx, 0);
  EXPECT_EQ(best_shift(before, frame_of({}), 4).repeatability.share(), 0);
}

TEST(Repeatability, FollowsIdentities) {
  const auto with_id = [](Curve curve, std::int64_t id) {
    curve.id = id;
    return curve;
  };
  // Edge 1 in two pieces, edge 4, edge 9; the next frame shows 1, 4 and 7.
  const auto before =
      frame_of({with_id(line({0, 40}, {20, 40}), 4), with_id(line({0, 10}, {40, 10}), 1),
                with_id(line({50, 10}, {60, 10}), 1), with_id(line({0, 60}, {30, 60}), 9),
                line({0, 70}, {90, 70})});
  const auto after =
      frame_of({with_id(line({0, 15}, {40, 15}), 1), with_id(line({0, 45}, {20, 45}), 4),
                with_id(line({0, 66}, {30, 66}), 7)});
  // All of 4 and 9, and 30 of the 50 px of edge 1.
  const auto first = found_by_id(
      frame_of({line({0, 40}, {20, 40}), line({0, 60}, {30, 60}), line({0, 10}, {30, 10})}), before,
      0.01);
  ASSERT_EQ(first.size(), 3U);
  EXPECT_EQ(first[0].id, 1);
  EXPECT_NEAR(first[0].true_px, 50, 1e-9);
  EXPECT_NEAR(first[0].found_px, 30, 0.3);
  EXPECT_EQ(first[2].id, 9);
  // Less than half of 1, all of 4.
  const auto second =
      found_by_id(frame_of({line({0, 15}, {19, 15}), line({0, 45}, {20, 45})}), after, 0.01);
  auto result = repeatability_by_id(first, second);
  EXPECT_NEAR(result.found_px, 70, 1e-9);
  EXPECT_NEAR(result.again_px, 20, 1e-9);
  EXPECT_NEAR(result.share(), 2 / 7.0, 1e-9);
  result += result;
  EXPECT_NEAR(result.found_px, 140, 1e-9);
  // The way back: 1 was not found, 4 was.
  EXPECT_NEAR(repeatability_by_id(second, first).share(), 1, 1e-9);
  EXPECT_TRUE(std::isnan(repeatability_by_id(first, {}).share()));
}

TEST(Drawing, PaintsThePixelsThatCurvesPass) {
  CurveFrame frame;
  frame.width = 6;
  frame.height = 3;
  Curve strong;
  strong.points = {{-3, 1.4}, {9, 1.4}};
  strong.contrast_counts = 30;
  Curve weak;
  weak.points = {{2, 2}};
  weak.contrast_counts = 5;
  frame.curves = {strong, weak};
  Image<std::uint8_t> map;
  draw_curves(frame, 0, map);
  for (int x = 0; x < 6; ++x) {
    EXPECT_EQ(map(x, 0), 0);
    EXPECT_EQ(map(x, 1), 255);
    EXPECT_EQ(map(x, 2), x == 2 ? 255 : 0);
  }
  draw_curves(frame, 10, map);
  EXPECT_EQ(map(2, 2), 0);
  EXPECT_EQ(map(2, 1), 255);
  EXPECT_EQ(pixels_as_curves(map.view()).curves.size(), 6U);
}

TEST(CurvesJson, IsReadWithWhatMayBeAbsent) {
  const auto frame = parse_curves(
      R"({"frame": 3, "width": 64, "height": 48, "sigma_counts": 5.5, "pose": {"x": [1]},
          "edges": [{"points": [[1, 2.5], [3, 4]], "contrast_counts": 12.5, "closed": true,
                     "kind": "crease", "id": 7},
                    {"points": [], "contrast_counts": null}]})",
      "name");
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->width, 64);
  EXPECT_EQ(frame->height, 48);
  EXPECT_EQ(frame->sigma_counts, 5.5);
  ASSERT_EQ(frame->curves.size(), 2U);
  EXPECT_EQ(frame->curves[0].points[0].y, 2.5);
  EXPECT_EQ(frame->curves[0].contrast_counts, 12.5);
  EXPECT_TRUE(frame->curves[0].closed);
  EXPECT_EQ(frame->curves[0].id, 7);
  EXPECT_EQ(frame->curves[1].id, -1);
  EXPECT_TRUE(std::isnan(frame->curves[1].contrast_counts));
  const auto bare = parse_curves(R"({"width": 1, "height": 1, "edges": []})", "name");
  ASSERT_TRUE(bare);
  EXPECT_TRUE(std::isnan(bare->sigma_counts));
}

TEST(CurvesJson, SaysWhatIsWrong) {
  const std::string head = R"({"width": 4, "height": 4, "edges": )";
  const std::string object = "t.json: should be a JSON object with width, height and edges";
  const std::string size = "t.json: width and height should be whole numbers of px, 1 to 16384";
  const std::string points = "t.json: edge 0: points should be a list of [x, y] in px";
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"", object},
           {"[1]", object},
           {head + "[]", object},
           {R"({"height": 4, "edges": []})", size},
           {R"({"width": 0, "height": 4, "edges": []})", size},
           {R"({"width": 4, "height": 16385, "edges": []})", size},
           {R"({"width": 4.5, "height": 4, "edges": []})", size},
           {R"({"width": 4, "height": 4})", "t.json: edges should be a list"},
           {R"({"width": 4, "height": 4, "sigma_counts": -1, "edges": []})",
            "t.json: sigma_counts should be a number from 0 up, or null"},
           {head + "{}}", "t.json: edges should be a list"},
           {head + "[3]}", points},
           {head + "[{}]}", points},
           {head + R"([{"points": [1, 2]}]})", points},
           {head + R"([{"points": [[1]]}]})", points},
           {head + R"([{"points": [[1, "2"]]}]})", points},
           {head + R"([{"points": [[1, 1e300]]}]})", points},
           {head + R"([{"points": [[0, 0], [40, 0], [0, 0]]}]})",
            "t.json: edges of 80 px in all are more than a frame of 4x4 pixels holds"},
           {head + R"([{"points": [], "closed": 1}]})",
            "t.json: edge 0: closed should be true or false"},
           {head + R"([{"points": [], "id": -2}]})",
            "t.json: edge 0: id should be a whole number from 0 up, or null"},
           {head + R"([{"points": [], "contrast_counts": "many"}]})",
            "t.json: edge 0: contrast_counts should be a number from 0 up, or null"}}) {
    const auto frame = parse_curves(text, "t.json");
    ASSERT_FALSE(frame) << text;
    EXPECT_EQ(frame.error().message, message) << text;
  }
}

}  // namespace
}  // namespace thermedge::eval
