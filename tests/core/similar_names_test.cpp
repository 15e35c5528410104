#include "thermedge/similar_names.hpp"

#include <gtest/gtest.h>

namespace thermedge {
namespace {

using Names = std::vector<std::string>;

const Names kWords = {"detect", "denoise", "trace", "scale", "stages", "simulate"};

TEST(SimilarNames, AreThoseWithFewMistakes) {
  EXPECT_EQ(similar_names("detct", kWords), Names{"detect"}) << "a letter is missing";
  EXPECT_EQ(similar_names("dettect", kWords), Names{"detect"}) << "one too many";
  EXPECT_EQ(similar_names("detekt", kWords), Names{"detect"}) << "a wrong one";
  EXPECT_EQ(similar_names("dtetect", kWords), Names{"detect"});
  EXPECT_EQ(similar_names("tarce", kWords), Names{"trace"}) << "two exchanged";
  EXPECT_EQ(similar_names("Scale", kWords), Names{"scale"});
  EXPECT_EQ(similar_names("keep-edge", Names{"keep_edges"}), Names{"keep_edges"});
  EXPECT_EQ(similar_names("sim", kWords), Names{"simulate"}) << "a beginning";
  EXPECT_EQ(similar_names("", kWords), Names{});
  EXPECT_EQ(similar_names("x", kWords), Names{}) << "all of it is wrong";
  EXPECT_EQ(similar_names("zebra", kWords), Names{});
  EXPECT_EQ(similar_names(std::string(100000, 'a'), kWords), Names{});
}

TEST(SimilarNames, AreSortedAndFew) {
  EXPECT_EQ(similar_names("bat", Names{"boat", "bat1", "cat", "bad", "bet"}),
            (Names{"boat", "bat1", "cat"}));
  EXPECT_EQ(similar_names("frames", Names{"frame_s", "frames_", "frames"})[0], "frames");
}

TEST(SimilarNames, AreSaidInWords) {
  EXPECT_EQ(did_you_mean("detct", kWords), "; did you mean detect?");
  EXPECT_EQ(did_you_mean("cat", Names{"bat", "hat"}), "; did you mean bat or hat?");
  EXPECT_EQ(did_you_mean("cat", Names{"bat", "hat", "rat"}), "; did you mean bat, hat or rat?");
  EXPECT_EQ(did_you_mean("zebra", kWords), "");
}

}  // namespace
}  // namespace thermedge
