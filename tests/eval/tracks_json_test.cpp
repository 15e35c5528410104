// Lines of tracks and of the simulator's truth, good and bad.
#include <gtest/gtest.h>

#include "thermedge/eval/tracks.hpp"

namespace thermedge::eval {
namespace {

constexpr const char* kPoints = R"("points":[[1,2],[2,2],[3,2]])";

std::string edge(const std::string& more) {
  return R"({"frame":3,"edges":[{)" + std::string(kPoints) + more + "}]}";
}

TEST(TrackedFrame, IsRead) {
  const auto frame = parse_tracked_frame(
      R"({"frame":3,"stamp_ns":1700000000000000000,"valid":true,"events":["offset_jump"],
          "sigma_counts":5.5,"motion":{"affine":[1]},"edges":[{)" +
          std::string(kPoints) +
          R"(,"closed":false,"track":8,"tracks":[[0,1,8],[2,3,9]],"smooth":[[1,2.1],null,[3,2]]}],
          "born":[9],"ended":[[4,"left"]],"merged":[]})",
      "t:1");
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->frame, 3);
  EXPECT_EQ(frame->stamp_ns, 1700000000000000000);
  EXPECT_TRUE(frame->valid);
  EXPECT_EQ(frame->sigma_counts, 5.5);
  EXPECT_EQ(frame->events, std::vector<std::string>{"offset_jump"});
  ASSERT_EQ(frame->edges.size(), 1U);
  const TrackedCurve& one = frame->edges[0];
  ASSERT_EQ(one.curve.points.size(), 3U);
  ASSERT_EQ(one.tracks.size(), 2U);
  EXPECT_EQ(one.tracks[1].from, 2U);
  EXPECT_EQ(one.tracks[1].to, 3U);
  EXPECT_EQ(one.tracks[1].id, 9);
  ASSERT_EQ(one.smooth.size(), 3U);
  EXPECT_EQ(one.smooth[0]->y, 2.1);
  EXPECT_FALSE(one.smooth[1]);
}

TEST(TrackedFrame, MayHoldLess) {
  const auto whole = parse_tracked_frame(edge(R"(,"track":8)"), "t:1");
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_FALSE(whole->stamp_ns);
  ASSERT_EQ(whole->edges[0].tracks.size(), 1U);
  EXPECT_EQ(whole->edges[0].tracks[0].to, 3U);
  const auto none = parse_tracked_frame(edge(R"(,"track":null,"smooth":[])"), "t:1");
  ASSERT_TRUE(none) << none.error().message;
  EXPECT_TRUE(none->edges[0].tracks.empty());
  // Runs say more than the edge's own identity.
  const auto runs = parse_tracked_frame(edge(R"(,"track":8,"tracks":[])"), "t:1");
  ASSERT_TRUE(runs);
  EXPECT_TRUE(runs->edges[0].tracks.empty());
  const auto invalid = parse_tracked_frame(R"({"frame":0,"valid":false})", "t:1");
  ASSERT_TRUE(invalid) << invalid.error().message;
  EXPECT_FALSE(invalid->valid);
}

struct Bad {
  std::string json;
  std::string message;
};

TEST(TrackedFrame, ErrorsNameLineAndField) {
  for (const Bad& bad : std::vector<Bad>{
           {"[1]", "t:1: should be a JSON object with frame and edges"},
           {"{", "t:1: should be a JSON object"},
           {R"({"edges":[]})", "t:1: frame should be a whole number"},
           {R"({"frame":-1,"edges":[]})", "t:1: frame should be a whole number"},
           {R"({"frame":18446744073709551615,"edges":[]})", "t:1: frame should be a whole number"},
           {R"({"frame":1})", "t:1: edges should be a list"},
           {R"({"frame":1,"edges":{"a":1}})", "t:1: edges should be a list"},
           {R"({"frame":1,"valid":1,"edges":[]})", "t:1: valid should be true or false"},
           {R"({"frame":1,"stamp_ns":1.5,"edges":[]})", "t:1: stamp_ns should be a whole number"},
           {R"({"frame":1,"events":[1],"edges":[]})", "t:1: events should be a list"},
           {R"({"frame":1,"sigma_counts":-1,"edges":[]})", "t:1: sigma_counts should be"},
           {R"({"frame":1,"edges":[3]})", "t:1: edge 0: points should be"},
           {edge(R"(,"track":-2)"), "t:1: edge 0: track should be a whole number"},
           {edge(R"(,"tracks":[[0,1]])"), "t:1: edge 0: tracks should be a list of [from, to, id]"},
           {edge(R"(,"tracks":[[0,4,1]])"), "t:1: edge 0: tracks should be"},
           {edge(R"(,"tracks":[[1,1,1]])"), "t:1: edge 0: tracks should be"},
           {edge(R"(,"tracks":[[0,2,1],[1,3,2]])"), "t:1: edge 0: tracks should be"},
           {edge(R"(,"tracks":[[2,3,1],[0,1,2]])"), "t:1: edge 0: tracks should be"},
           {edge(R"(,"tracks":[[0,1,-3]])"), "t:1: edge 0: tracks should be"},
           {edge(R"(,"tracks":"all")"), "t:1: edge 0: tracks should be"},
           {edge(R"(,"smooth":[[1,2]])"), "t:1: edge 0: smooth should be a list"},
           {edge(R"(,"smooth":[[1,2],[1e9,2],[1,2]])"), "t:1: edge 0: smooth should be a list"}}) {
    const auto frame = parse_tracked_frame(bad.json, "t:1");
    ASSERT_FALSE(frame) << bad.json;
    EXPECT_EQ(frame.error().message.find(bad.message), 0U) << frame.error().message;
    EXPECT_EQ(frame.error().message.find('\n'), std::string::npos);
  }
}

std::string truth(const std::string& more, const std::string& id = R"("id":1,)") {
  return R"({"frame":3,"stamp_ns":5,"width":160,"height":120,)" + more + R"("edges":[{)" + id +
         kPoints + "}]}";
}

TEST(TrackTruth, IsRead) {
  const auto frame =
      parse_track_truth(truth(R"("pose":{"position_m":[0,0,1],"orientation_xyzw":[0,0.6,0,0.8]},
               "intrinsics":{"fx_px":200,"fy_px":201,"cx_px":80,"cy_px":60,"k1":-0.1,"k2":0},
               "shutter":{"frozen":true,"shows_frame":2,"jump_counts":0},"events":["frozen"],)"),
                        "t:1");
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_TRUE(frame->frozen);
  EXPECT_EQ(frame->events, std::vector<std::string>{"frozen"});
  ASSERT_TRUE(frame->camera);
  EXPECT_EQ(frame->camera->fy_px, 201);
  EXPECT_EQ(frame->camera->orientation_xyzw[1], 0.6);
  EXPECT_EQ(frame->edges.curves.at(0).id, 1);
  const auto plain = parse_track_truth(truth(R"("shutter":null,)"), "t:1");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_FALSE(plain->frozen);
  EXPECT_FALSE(plain->camera);
}

TEST(TrackTruth, ErrorsNameLineAndField) {
  for (const Bad& bad : std::vector<Bad>{
           {R"({"frame":3,"edges":[]})", "t:1: stamp_ns should be a whole number"},
           {R"({"frame":3,"stamp_ns":3,"edges":[]})", "t:1: width and height should be"},
           {truth("", ""), "t:1: each edge should have an id"},
           {truth(R"("shutter":{"frozen":3},)"), "t:1: shutter should be null or hold frozen"},
           {truth(R"("pose":{},"intrinsics":{},)"), "t:1: intrinsics should hold fx_px"},
           {truth(R"("pose":{"orientation_xyzw":[1,1,0,0]},"intrinsics":{"fx_px":1,"fy_px":1,
                     "cx_px":0,"cy_px":0,"k1":0,"k2":0},)"),
            "t:1: pose should hold orientation_xyzw"}}) {
    const auto frame = parse_track_truth(bad.json, "t:1");
    ASSERT_FALSE(frame) << bad.json;
    EXPECT_EQ(frame.error().message.find(bad.message), 0U) << frame.error().message;
  }
}

}  // namespace
}  // namespace thermedge::eval
