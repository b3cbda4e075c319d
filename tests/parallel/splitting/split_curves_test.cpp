// SPDX-License-Identifier: BSD-3-Clause
// Splits the curves of small meshes that are cut into slabs anywhere, and compares the result with that of one rank.
#include "splitting/split_curves.hpp"

#include "comm/agree.hpp"
#include "support/mesh_slabs.hpp"
#include "trime/handover/local_mesh.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace trime::splitting {
namespace {

using mesh::DistributedMesh;

/// Never freed: MPI is finalised before statics are.
const comm::Communicator& world() {
  static const comm::Communicator& world = *new comm::Communicator(comm::Communicator::world());
  return world;
}

constexpr std::int32_t parts = 2; // of the divided square: its hole and its rim

/// The loops of the divided square.
std::vector<polygon::LoopSummary> loops_before(const DistributedMesh& whole) {
  using Kind = polygon::LoopSummary::Kind;
  std::vector<polygon::LoopSummary> loops{{1, Kind::outer, 0, 0, {1}}, {2, Kind::hole, 0, 0, {0}}};
  for (const std::int32_t tag : whole.facet_tags)
    ++loops[static_cast<std::size_t>(tag - 1)].edges;
  return loops;
}

/// Splits the mesh whose parts the ranks hold. @param chosen whether each curve is split
SplitLoops split(const comm::Communicator& comm, const std::array<bool, 2>& chosen, const DistributedMesh& whole,
                 DistributedMesh& mesh) {
  const std::vector<geometry::CurveKind> kinds{{chosen[0]}, {chosen[1]}};
  const std::vector<polygon::LoopSummary> loops = loops_before(whole);
  const sizing::UniformSize size;
  return split_curves(comm, {kinds, parts, size, loops}, mesh);
}

/// The mesh of all ranks. Triangles and facets are sorted, since slabs that are cut anywhere do not keep their order.
struct Gathered {
  std::vector<geometry::Vec2> points;
  std::vector<std::int32_t> boundary, numbers, curves, paths;
  std::vector<std::array<GlobalId, 3>> triangles;
  std::vector<std::array<GlobalId, 4>> facets; // with tag and part
  std::vector<std::array<GlobalId, 2>> curve_edges, interfaces, pairs;
  std::uint64_t points_total = 0;

  bool operator==(const Gathered&) const = default;
};

template <class Vector>
auto everywhere(const comm::Communicator& comm, const Vector& list) {
  return comm::gather_everywhere(comm, std::vector<typename Vector::value_type>(list.begin(), list.end()));
}

Gathered gathered(const comm::Communicator& comm, const DistributedMesh& mesh) {
  std::vector<std::array<GlobalId, 4>> facets;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    facets.push_back({mesh.facets[k][0], mesh.facets[k][1], mesh.facet_tags[k], mesh.facet_parts[k]});
  Gathered all;
  all.points = everywhere(comm, mesh.points);
  all.boundary = everywhere(comm, mesh.boundary);
  all.numbers = everywhere(comm, mesh.curve_numbers);
  all.triangles = everywhere(comm, mesh::global_triangles(mesh));
  all.facets = everywhere(comm, facets);
  all.curve_edges = everywhere(comm, mesh.curve_edges);
  all.interfaces = everywhere(comm, mesh.interfaces);
  all.pairs = everywhere(comm, mesh.split_pairs);
  all.curves = everywhere(comm, mesh.split_curves);
  all.paths = everywhere(comm, mesh.split_paths);
  all.points_total = static_cast<std::uint64_t>(mesh.point_slab.total);
  std::sort(all.triangles.begin(), all.triangles.end());
  std::sort(all.facets.begin(), all.facets.end());
  return all;
}

/// Edges with one triangle, which lies on their left.
std::set<std::array<GlobalId, 2>> rim_of(const Gathered& mesh) {
  std::set<std::array<GlobalId, 2>> sides, rim;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sides.insert({t[k], t[(k + 1) % 3]});
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a}))
      rim.insert({a, b});
  return rim;
}

class SplitCurves : public ::testing::TestWithParam<std::array<bool, 2>> {};

TEST_P(SplitCurves, AreTheSameOnAllRanksAndHaveFacetsOnBothSides) {
  for (const int n : {5, 11}) {
    const DistributedMesh whole = test::divided_square(n);
    DistributedMesh alone = whole;
    const comm::Communicator self = comm::Communicator::self();
    const SplitLoops loops = split(self, GetParam(), whole, alone);
    const Gathered reference = gathered(self, alone);
    std::set<std::array<GlobalId, 2>> facets;
    for (const auto& facet : reference.facets)
      facets.insert({facet[0], facet[1]});
    EXPECT_EQ(rim_of(reference), facets);
    EXPECT_EQ(reference.points.size(), reference.points_total);
    for (const auto& [left, right] : reference.pairs) {
      EXPECT_NE(left, right);
      EXPECT_EQ(reference.points[static_cast<std::size_t>(left)], reference.points[static_cast<std::size_t>(right)]);
    }
    EXPECT_TRUE(split_check(alone, loops.loops).passed) << split_check(alone, loops.loops).found;
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      DistributedMesh part = test::slabs_of(whole, world(), seed);
      const SplitLoops of_part = split(world(), GetParam(), whole, part);
      EXPECT_TRUE(gathered(world(), part) == reference) << "slabs cut by seed " << seed;
      EXPECT_EQ(of_part.loops.size(), loops.loops.size());
      EXPECT_EQ(of_part.new_tags, loops.new_tags);
    }
  }
}

TEST_P(SplitCurves, AreHandedOver) {
  const DistributedMesh whole = test::divided_square(7);
  DistributedMesh part = test::slabs_of(whole, world(), 5);
  split(world(), GetParam(), whole, part);
  const Gathered all = gathered(world(), part);
  const handover::LocalMesh local = handover::make_local_mesh(world(), part);
  std::int64_t sides = 0, left = 0;
  for (std::size_t k = 0; k < at(local.owned_facets); ++k)
    sides += local.facet_parts[k] >= parts;
  const auto is_owned = [&](GlobalId id) {
    return id >= local.first_point && id < local.first_point + local.owned_points;
  };
  for (std::size_t k = 0; k < local.split_pairs.size(); ++k) {
    EXPECT_EQ(local.split_pairs[k], all.pairs[static_cast<std::size_t>(local.split_rows[k])]);
    EXPECT_TRUE(is_owned(local.split_pairs[k][0]) || is_owned(local.split_pairs[k][1]));
    left += is_owned(local.split_pairs[k][0]) ? 1 : 0;
  }
  EXPECT_EQ(world().sum(left), std::ssize(all.pairs));
  EXPECT_EQ(world().sum(sides), std::ranges::count_if(all.facets, [](const auto& facet) { return facet[3] >= parts; }));
}

INSTANTIATE_TEST_SUITE_P(Choices, SplitCurves,
                         ::testing::Values(std::array{true, false}, std::array{false, true}, std::array{true, true}));

} // namespace
} // namespace trime::splitting
