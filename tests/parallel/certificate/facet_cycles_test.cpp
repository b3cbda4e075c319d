// SPDX-License-Identifier: BSD-3-Clause
// Cycles of facets are counted right, however the facets lie on the ranks.
#include "certificate/facet_cycles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace trime::certificate {
namespace {

/// Of all ranks together; facet k lies on rank k * stride mod ranks.
CycleCounts count(const std::vector<TaggedFacet>& facets, GlobalId points, std::size_t stride) {
  const comm::Communicator comm = comm::Communicator::world();
  std::vector<TaggedFacet> mine;
  for (std::size_t k = 0; k < facets.size(); ++k)
    if (static_cast<int>(k * stride % static_cast<std::size_t>(comm.size())) == comm.rank())
      mine.push_back(facets[k]);
  const CycleCounts counts = count_cycles(mine, points, comm);
  std::array<std::int64_t, 4> sums{counts.irregular, counts.cycles, counts.changes,
                                   static_cast<std::int64_t>(counts.tags)};
  comm.sum(sums);
  return {sums[0], sums[1], sums[2], static_cast<std::uint64_t>(sums[3])};
}

void expect(const std::vector<TaggedFacet>& facets, GlobalId points, const CycleCounts& expected, const char* what) {
  for (const std::size_t stride : {0, 1, 2}) { // 0: all lie on rank 0
    const CycleCounts found = count(facets, points, stride);
    EXPECT_EQ(found.irregular, expected.irregular) << what;
    EXPECT_EQ(found.cycles, expected.cycles) << what;
    EXPECT_EQ(found.changes, expected.changes) << what;
    EXPECT_EQ(found.tags, expected.tags) << what;
  }
}

TEST(FacetCycles, AreFollowedRound) {
  const std::vector<TaggedFacet> two{{1, 7, 1}, {7, 4, 1}, {4, 1, 1}, {9, 2, 2}, {2, 3, 2}, {3, 9, 2}};
  const std::uint64_t both = tag_hash(1) + tag_hash(2);
  constexpr GlobalId points = 10;
  expect({}, points, {0, 0, 0, 0}, "the whole torus");
  expect(two, points, {0, 2, 0, both}, "two loops");
  expect(two, 3, {0, 2, 0, both}, "ids that no rank should have");
  auto facets = two;
  facets[5].tag = 1;
  expect(facets, points, {0, 2, 2, both}, "one tag wrong, not at the lowest point");
  facets = two;
  for (std::size_t k = 3; k < 6; ++k)
    facets[k].tag = 1;
  expect(facets, points, {0, 2, 0, 2 * tag_hash(1)}, "two loops of one tag");
  facets = two;
  facets.pop_back();
  expect(facets, points, {2, 1, 0, tag_hash(1)}, "one facet missing: what is left of its loop is open");
  facets = two;
  std::swap(facets[1].first, facets[1].second);
  expect(facets, points, {2, 1, 0, tag_hash(2)}, "one facet turned round");
  facets = two;
  facets[3].first = facets[5].second = 1;
  expect(facets, points, {1, 0, 0, 0}, "loops that touch in a point");
  facets = two;
  facets.push_back(facets[4]);
  expect(facets, points, {2, 1, 0, tag_hash(1)}, "one facet twice");
  facets = two;
  std::swap(facets[0].second, facets[3].second);
  expect(facets, points, {0, 1, 2, tag_hash(1)}, "two loops joined to one");
}

TEST(FacetCycles, MayVisitRanksInAnyOrder) {
  // One cycle in steps that lead across all ranks, and many small ones beside it.
  constexpr GlobalId points = 1009, step = 389, small = 3; // 1009 is a prime
  std::vector<TaggedFacet> facets;
  for (GlobalId k = 0; k < points; ++k)
    facets.push_back({k, (k + step) % points, 5});
  expect(facets, points, {0, 1, 0, tag_hash(5)}, "one long cycle");
  const GlobalId cycles = 100;
  std::uint64_t tags = tag_hash(5);
  for (GlobalId c = 0; c < cycles; ++c) {
    for (GlobalId k = 0; k < small; ++k)
      facets.push_back({points + c + k * cycles, points + c + (k + 1) % small * cycles, 6 + c});
    tags += tag_hash(6 + c);
  }
  expect(facets, points + small * cycles, {0, 1 + cycles, 0, tags}, "beside small ones");
  facets[17].second = facets[18].second;
  expect(facets, points + small * cycles, {2, cycles, 0, tags - tag_hash(5)}, "the long one broken");
}

} // namespace
} // namespace trime::certificate
