#include "thermedge/edge_set.hpp"

#include <gtest/gtest.h>

namespace thermedge {
namespace {

TEST(Edgels, AllArraysHaveOneLength) {
  Edgels edgels;
  edgels.reserve(10);
  const float* before = edgels.position_sigma_px.data();
  edgels.resize(7);
  EXPECT_EQ(edgels.size(), 7U);
  EXPECT_EQ(edgels.position_sigma_px.data(), before);
  for (const auto* values : {&edgels.x, &edgels.y, &edgels.nx, &edgels.ny, &edgels.magnitude_counts,
                             &edgels.position_sigma_px}) {
    EXPECT_EQ(*values, std::vector<float>(7, 0.0F));
    EXPECT_GE(values->capacity(), 10U);
  }
  for (const auto* values : {&edgels.edge, &edgels.previous, &edgels.next}) {
    EXPECT_EQ(*values, std::vector<std::int32_t>(7, 0));
    EXPECT_GE(values->capacity(), 10U);
  }
}

TEST(EdgeSet, ClearLeavesNothingButMemory) {
  EdgeSet edges;
  edges.edgels.resize(5);
  edges.edges.resize(2);
  edges.corners = {0, 1};
  edges.connections = {1, 0};
  edges.junctions.push_back({});
  edges.kept = 1;
  edges.clear();
  EXPECT_EQ(edges.edgels.size(), 0U);
  EXPECT_TRUE(edges.edgels.next.empty());
  EXPECT_TRUE(edges.edges.empty());
  EXPECT_TRUE(edges.corners.empty());
  EXPECT_TRUE(edges.connections.empty());
  EXPECT_TRUE(edges.junctions.empty());
  EXPECT_TRUE(edges.kept_edges().empty());
  EXPECT_GE(edges.edgels.x.capacity(), 5U);
}

TEST(EdgeSet, ViewsOfOneEdge) {
  EdgeSet edges;
  edges.corners = {0, 4, 9, 0, 7};
  edges.connections = {1, 2, 0, 0};
  Edge edge;
  edge.corners = {3, 2};
  edge.connections = {1, 1};
  EXPECT_EQ(edges.corners_of(edge)[1], 7U);
  ASSERT_EQ(edges.connections_of(edge).size(), 1U);
  EXPECT_EQ(edges.connections_of(edge)[0], 2);
}

}  // namespace
}  // namespace thermedge
