// SPDX-License-Identifier: BSD-3-Clause
#include "formats/boundary_loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::formats {
namespace {

/// A closed chain of edges through these points, with ids from `first_id` on.
std::vector<LoopEdge> chain(const std::vector<geometry::Vec2>& places, GlobalId first_id, std::int64_t tag) {
  std::vector<LoopEdge> edges;
  const auto n = static_cast<GlobalId>(places.size());
  for (GlobalId k = 0; k < n; ++k)
    edges.push_back({first_id + k, first_id + (k + 1) % n, tag, places[static_cast<std::size_t>(k)]});
  return edges;
}

std::vector<GlobalId> ids(const std::vector<LoopVertex>& loop) {
  std::vector<GlobalId> result;
  for (const LoopVertex& vertex : loop)
    result.push_back(vertex.id);
  return result;
}

std::vector<LoopEdge> joined(std::vector<LoopEdge> a, const std::vector<LoopEdge>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const std::vector<geometry::Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const std::vector<geometry::Vec2> clockwise_hole{{0.4, 0.4}, {0.4, 0.6}, {0.6, 0.6}, {0.6, 0.4}};

TEST(BoundaryLoops, RunCounterClockwiseFromTheirLowestVertexByTag) {
  const std::vector<LoopEdge> edges = joined(chain(clockwise_hole, 2, 2), chain(square, 10, 1));
  for (int order = 0; order < 8; ++order) {
    std::vector<LoopEdge> turned = edges;
    std::rotate(turned.begin(), turned.begin() + order, turned.end());
    const auto loops = boundary_loops(turned, {0, 0});
    ASSERT_EQ(loops.size(), 2u);
    EXPECT_EQ(ids(loops[0]), (std::vector<GlobalId>{10, 11, 12, 13}));
    EXPECT_EQ(ids(loops[1]), (std::vector<GlobalId>{2, 5, 4, 3}));
    EXPECT_EQ(loops[1][1].place, (geometry::Vec2{0.6, 0.4}));
  }
}

TEST(BoundaryLoops, ThatTouchInAPointStayApart) {
  std::vector<LoopEdge> edges = joined(chain(square, 0, 1), chain({{1, 1}, {2, 1}, {2, 2}}, 10, 2));
  for (LoopEdge& edge : edges) { // vertex 10 is vertex 2
    edge.first = edge.first == 10 ? 2 : edge.first;
    edge.second = edge.second == 10 ? 2 : edge.second;
  }
  const auto loops = boundary_loops(edges, {0, 0});
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(ids(loops[0]), (std::vector<GlobalId>{0, 1, 2, 3}));
  EXPECT_EQ(ids(loops[1]), (std::vector<GlobalId>{2, 11, 12}));
}

TEST(BoundaryLoops, CrossThePeriodicBorder) {
  const std::vector<geometry::Vec2> hole{{0.9, 0.4}, {0.9, 0.6}, {0.1, 0.6}, {0.1, 0.4}}; // clockwise over x = 1
  EXPECT_EQ(ids(boundary_loops(chain(hole, 0, 1), {1, 0}).at(0)), (std::vector<GlobalId>{0, 3, 2, 1}));
  EXPECT_EQ(ids(boundary_loops(chain(hole, 0, 1), {0, 0}).at(0)), (std::vector<GlobalId>{0, 1, 2, 3}));
  const std::vector<geometry::Vec2> belt{{0.9, 0.5}, {0.5, 0.5}, {0.1, 0.5}}; // winds round: no sense of rotation
  EXPECT_EQ(ids(boundary_loops(chain(belt, 0, 1), {1, 0}).at(0)), (std::vector<GlobalId>{0, 1, 2}));
}

TEST(BoundaryLoops, EndWhereTheChainIsBroken) {
  std::vector<LoopEdge> edges = chain(square, 0, 1);
  edges.erase(edges.begin() + 2);
  const auto loops = boundary_loops(edges, {0, 0});
  std::size_t count = 0;
  for (const auto& loop : loops)
    count += loop.size();
  EXPECT_EQ(count, 3u);
  EXPECT_TRUE(boundary_loops({}, {0, 0}).empty());
}

} // namespace
} // namespace trime::formats
