// SPDX-License-Identifier: BSD-3-Clause
// The parts of a mesh that solvers get, against the whole mesh on every rank: meshes of the mesher, and slabs cut
// anywhere, empty ones included.
#include "trime/handover/local_mesh.hpp"

#include "support/distributed.hpp"
#include "support/mesh_slabs.hpp"
#include "support/periodic_shapes.hpp"
#include "support/plain_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace trime::handover {
namespace {

using geometry::Vec2;
using mesh::DistributedMesh;

/// Never freed: MPI is finalised before statics are.
const comm::Communicator& world() {
  static const comm::Communicator& world = *new comm::Communicator(comm::Communicator::world());
  return world;
}

struct Case {
  std::string name;
  DistributedMesh whole, part;
};

Case meshed(const std::string& name, const geometry::Domain& domain) {
  meshing::MeshOptions options;
  options.points = 600;
  options.method = sweep::Method::distmesh;
  options.max_sweeps = 5;
  const sizing::UniformSize size;
  return {name, testing::mesh_silently(comm::Communicator::self(), domain, size, options).mesh,
          testing::mesh_silently(world(), domain, size, options).mesh};
}

const std::vector<Case>& cases() {
  static const std::vector<Case> made = [] {
    std::vector<Case> list;
    list.push_back(meshed("disc with a hole", testing::disc_with_hole().domain()));
    list.push_back(meshed("thin triangle", testing::triangle({0.1, 0.5}, {0.9, 0.5}, {0.6, 0.54}).domain()));
    list.push_back(meshed("periodic", testing::periodic_shapes().front().domain()));
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
      const DistributedMesh whole = test::holed_square(seed % 2 == 0 ? 3 : 11);
      list.push_back({"slabs cut by seed " + std::to_string(seed), whole, test::slabs_of(whole, world(), seed)});
    }
    return list;
  }();
  return made;
}

/// Calls check(case, local mesh) for all meshes with both kinds of overlap.
template <class Check>
void for_all(const Check& check) {
  for (const Case& c : cases())
    for (const Overlap overlap : {Overlap::none, Overlap::triangles}) {
      SCOPED_TRACE(c.name + (overlap == Overlap::none ? ", no overlap" : ", overlap"));
      check(c, make_local_mesh(world(), c.part, overlap), overlap);
    }
}

using Ids = std::array<GlobalId, 3>;

Ids global(const LocalMesh& mesh, const std::array<LocalIndex, 3>& triangle) {
  return {mesh.global_id(triangle[0]), mesh.global_id(triangle[1]), mesh.global_id(triangle[2])};
}
std::array<GlobalId, 2> global(const LocalMesh& mesh, const std::array<LocalIndex, 2>& facet) {
  return {mesh.global_id(facet[0]), mesh.global_id(facet[1])};
}
/// The first of a list, those that a rank owns.
template <class Vector>
Vector first(const Vector& list, LocalIndex count) {
  return Vector(list.begin(), list.begin() + count);
}

TEST(LocalMesh, EveryTriangleHasOneOwnerAndItsLowestVertexThere) {
  for_all([](const Case& c, const LocalMesh& mesh, Overlap overlap) {
    std::vector<GlobalId> ids = testing::gather_all(world(), first(mesh.triangle_ids, mesh.owned_triangles));
    std::sort(ids.begin(), ids.end());
    ASSERT_EQ(std::ssize(ids), c.whole.triangle_slab.total);
    for (std::size_t k = 0; k < ids.size(); ++k)
      ASSERT_EQ(ids[k], static_cast<GlobalId>(k));
    ASSERT_EQ(mesh.triangles.size(), mesh.triangle_ids.size());
    EXPECT_TRUE(overlap == Overlap::triangles || std::ssize(mesh.triangles) == mesh.owned_triangles);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      EXPECT_EQ(global(mesh, mesh.triangles[t]), c.whole.triangle_ids(static_cast<std::size_t>(mesh.triangle_ids[t])));
      EXPECT_EQ(mesh.triangles[t][0] < mesh.owned_points, static_cast<LocalIndex>(t) < mesh.owned_triangles);
    }
    EXPECT_EQ(mesh.total_points, c.whole.point_slab.total);
    EXPECT_EQ(mesh.total_triangles, c.whole.triangle_slab.total);
  });
}

TEST(LocalMesh, GhostsAgreeWithTheirOwnersBitForBit) {
  for_all([](const Case& c, const LocalMesh& mesh, Overlap) {
    ASSERT_EQ(mesh.points.size(), at(mesh.owned_points) + mesh.ghost_ids.size());
    ASSERT_EQ(mesh.boundary.size(), mesh.points.size());
    for (LocalIndex i = 0; i < std::ssize(mesh.points); ++i) {
      const auto id = static_cast<std::size_t>(mesh.global_id(i));
      EXPECT_EQ(mesh.points[at(i)], c.whole.points[id]);
      EXPECT_EQ(mesh.boundary[at(i)], c.whole.boundary[id]);
    }
    std::vector<std::int64_t> owners(c.whole.points.size(), 0);
    for (LocalIndex i = 0; i < mesh.owned_points; ++i)
      owners[static_cast<std::size_t>(mesh.global_id(i))] = world().rank() + 1;
    world().sum(owners);
    for (std::size_t k = 0; k < mesh.ghost_ids.size(); ++k)
      EXPECT_EQ(mesh.ghost_owners[k] + 1, owners[static_cast<std::size_t>(mesh.ghost_ids[k])]);
    EXPECT_EQ(std::count(owners.begin(), owners.end(), 0), 0);
  });
}

TEST(LocalMesh, NoGhostIsWithoutUseAndOwnedPointsHaveAllTheirTriangles) {
  for_all([](const Case& c, const LocalMesh& mesh, Overlap overlap) {
    std::vector<int> here(mesh.points.size(), 0), everywhere(c.whole.points.size(), 0);
    for (const auto& triangle : mesh.triangles)
      for (const LocalIndex point : triangle)
        ++here[at(point)];
    for (std::size_t t = 0; t < c.whole.triangles.size(); ++t)
      for (const GlobalId point : c.whole.triangle_ids(t))
        ++everywhere[static_cast<std::size_t>(point)];
    for (LocalIndex i = 0; i < std::ssize(mesh.points); ++i) {
      const int expected = everywhere[static_cast<std::size_t>(mesh.global_id(i))];
      const bool whole = i < mesh.owned_points && overlap == Overlap::triangles;
      EXPECT_GE(here[at(i)], whole ? expected : i < mesh.owned_points ? 0 : 1);
    }
    for (const auto& triangle : mesh.triangles) // and no triangle is without an owned point
      EXPECT_LT(*std::min_element(triangle.begin(), triangle.end()), mesh.owned_points);
  });
}

TEST(LocalMesh, FacetsLieWithTheirTrianglesAndKeepTagsAndParts) {
  for_all([](const Case& c, const LocalMesh& mesh, Overlap) {
    std::map<std::array<GlobalId, 2>, std::pair<std::int32_t, std::int32_t>> expected;
    for (std::size_t k = 0; k < c.whole.facets.size(); ++k)
      expected[c.whole.facets[k]] = {c.whole.facet_tags[k], c.whole.facet_parts[k]};
    EXPECT_EQ(world().sum(std::int64_t{mesh.owned_facets}), c.whole.facet_slab.total);
    std::set<std::array<GlobalId, 2>> found;
    for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
      const auto ends = global(mesh, mesh.facets[k]);
      ASSERT_TRUE(expected.contains(ends));
      EXPECT_EQ(expected[ends], std::pair(mesh.facet_tags[k], mesh.facet_parts[k]));
      EXPECT_TRUE(found.insert(ends).second);
      const auto& corners = mesh.triangles.at(at(mesh.facet_triangles[k]));
      const auto start = std::find(corners.begin(), corners.end(), mesh.facets[k][0]) - corners.begin();
      ASSERT_LT(start, 3);
      EXPECT_EQ(corners[static_cast<std::size_t>((start + 1) % 3)], mesh.facets[k][1]);
      EXPECT_EQ(static_cast<LocalIndex>(k) < mesh.owned_facets, mesh.facet_triangles[k] < mesh.owned_triangles);
    }
    std::size_t of_local_triangles = 0;
    for (const auto& triangle : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        of_local_triangles += expected.contains({mesh.global_id(triangle[k]), mesh.global_id(triangle[(k + 1) % 3])});
    EXPECT_EQ(mesh.facets.size(), of_local_triangles);
  });
}

TEST(LocalMesh, RegionsComeWithTheTriangles) {
  DistributedMesh whole = test::holed_square(7);
  for (std::size_t t = 0; t < whole.region.size(); ++t)
    whole.region[t] = 1 + static_cast<std::int32_t>(t % 3);
  const LocalMesh mesh = make_local_mesh(world(), test::slabs_of(whole, world(), 3));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_EQ(mesh.regions.empty() ? 1 : mesh.regions[t], 1 + mesh.triangle_ids[t] % 3);
}

/// Ends of an edge inside, and its numbers.
struct ListedEdge {
  std::array<GlobalId, 2> ends;
  std::vector<std::int32_t> numbers;
  auto operator<=>(const ListedEdge&) const = default;
};

/// Checks edges inside against those of the whole mesh. `numbers` are those of a local edge.
template <class Numbers>
void expect_inner_edges(const LocalMesh& mesh, const DistributedMesh& whole, const std::set<ListedEdge>& expected,
                        const std::vector<std::array<LocalIndex, 2>>& edges,
                        const std::vector<std::array<LocalIndex, 2>>& triangles, const Numbers& numbers) {
  std::map<std::array<GlobalId, 2>, GlobalId> triangle_at; // on the left of a side
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      triangle_at[{whole.triangle_ids(t)[k], whole.triangle_ids(t)[(k + 1) % 3]}] = static_cast<GlobalId>(t);
  std::map<GlobalId, LocalIndex> local;
  for (std::size_t t = 0; t < mesh.triangle_ids.size(); ++t)
    local[mesh.triangle_ids[t]] = static_cast<LocalIndex>(t);
  const auto held = [&](const std::array<GlobalId, 2>& side) {
    const auto found = local.find(triangle_at.at(side));
    return found == local.end() ? -1 : found->second;
  };
  std::set<ListedEdge> found;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto ends = global(mesh, edges[k]);
    EXPECT_TRUE(expected.contains({ends, numbers(k)}));
    EXPECT_TRUE(found.insert({ends, numbers(k)}).second);
    EXPECT_EQ(triangles[k][0], held({ends[0], ends[1]}));
    EXPECT_EQ(triangles[k][1], held({ends[1], ends[0]}));
    EXPECT_TRUE(triangles[k][0] >= 0 || triangles[k][1] >= 0);
  }
  for (const ListedEdge& edge : expected) // all that a local triangle has are there
    EXPECT_EQ(found.contains(edge), held({edge.ends[0], edge.ends[1]}) >= 0 || held({edge.ends[1], edge.ends[0]}) >= 0);
}

TEST(LocalMesh, EdgesInsideKnowTheTrianglesOnBothSides) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6})
    for (const Overlap overlap : {Overlap::none, Overlap::triangles}) {
      const DistributedMesh whole = test::divided_square(seed % 2 == 0 ? 3 : 11);
      ASSERT_GT(whole.interfaces.size(), 2u);
      const LocalMesh mesh = make_local_mesh(world(), test::slabs_of(whole, world(), seed), overlap);
      std::set<ListedEdge> curves, interfaces;
      for (std::size_t k = 0; k < whole.curve_edges.size(); ++k)
        curves.insert({whole.curve_edges[k], {whole.curve_numbers[k]}});
      for (std::size_t k = 0; k < whole.interfaces.size(); ++k)
        interfaces.insert({whole.interfaces[k],
                           {whole.interface_regions[k][0], whole.interface_regions[k][1], whole.interface_pairs[k],
                            whole.interface_curves[k]}});
      expect_inner_edges(mesh, whole, curves, mesh.curve_edges, mesh.curve_triangles,
                         [&](std::size_t k) { return std::vector{mesh.curve_numbers.at(k)}; });
      expect_inner_edges(mesh, whole, interfaces, mesh.interfaces, mesh.interface_triangles, [&](std::size_t k) {
        return std::vector{mesh.interface_regions.at(k)[0], mesh.interface_regions.at(k)[1], mesh.interface_pairs.at(k),
                           mesh.interface_curves.at(k)};
      });
      EXPECT_EQ(world().sum(std::int64_t{mesh.owned_curve_edges}), whole.curve_slab.total);
      EXPECT_EQ(world().sum(std::int64_t{mesh.owned_interfaces}), whole.interface_slab.total);
      for (std::size_t k = 0; k < mesh.interfaces.size(); ++k) {
        const auto [left, right] = mesh.interface_triangles[k];
        EXPECT_EQ(static_cast<LocalIndex>(k) < mesh.owned_interfaces, left >= 0 && left < mesh.owned_triangles);
        if (overlap == Overlap::triangles &&
            (mesh.interfaces[k][0] < mesh.owned_points || mesh.interfaces[k][1] < mesh.owned_points)) {
          EXPECT_GE(std::min(left, right), 0);
        }
        for (const std::size_t side : {0, 1})
          if (const LocalIndex t = mesh.interface_triangles[k][side]; t >= 0) {
            EXPECT_EQ(mesh.regions.empty() ? 1 : mesh.regions[at(t)], mesh.interface_regions[k][side]);
          }
      }
    }
}

TEST(LocalMesh, InterfacesThatAreNoEdgesAreAnErrorOnAllRanks) {
  DistributedMesh whole = test::divided_square(5);
  whole.interfaces[1] = {0, static_cast<GlobalId>(whole.points.size()) - 1};
  EXPECT_THROW(make_local_mesh(world(), test::slabs_of(whole, world(), 2)), InternalError);
}

TEST(LocalMesh, FacetsWithoutATriangleAreAnErrorOnAllRanks) {
  DistributedMesh whole = test::holed_square(5);
  std::swap(whole.facets[3][0], whole.facets[3][1]); // its interior is on the wrong side
  EXPECT_THROW(make_local_mesh(world(), test::slabs_of(whole, world(), 2)), InternalError);
}

TEST(HaloExchange, GhostsGetTheValuesOfTheirOwners) {
  for_all([](const Case&, const LocalMesh& mesh, Overlap) {
    const auto value = [](GlobalId id, int component) { return std::sqrt(static_cast<double>(id) + 0.1 * component); };
    std::vector<double> values(2 * mesh.points.size(), -1);
    for (LocalIndex i = 0; i < mesh.owned_points; ++i)
      for (const int component : {0, 1})
        values[2 * at(i) + static_cast<std::size_t>(component)] = value(mesh.global_id(i), component);
    update_ghosts(world(), mesh, values, 2);
    for (LocalIndex i = 0; i < std::ssize(mesh.points); ++i)
      for (const int component : {0, 1})
        EXPECT_EQ(values[2 * at(i) + static_cast<std::size_t>(component)], value(mesh.global_id(i), component));
  });
}

TEST(HaloExchange, OwnersGetTheSumOfAllTheirGhosts) {
  for_all([](const Case& c, const LocalMesh& mesh, Overlap) {
    std::vector<std::int64_t> holders(c.whole.points.size(), 0);
    for (LocalIndex i = 0; i < std::ssize(mesh.points); ++i)
      ++holders[static_cast<std::size_t>(mesh.global_id(i))];
    world().sum(holders);
    std::vector<double> values(mesh.points.size(), 1);
    add_to_owners(world(), mesh, values);
    for (LocalIndex i = 0; i < std::ssize(mesh.points); ++i)
      EXPECT_EQ(values[at(i)],
                i < mesh.owned_points ? static_cast<double>(holders[static_cast<std::size_t>(mesh.global_id(i))]) : 1);
  });
}

/// Adds K u of a triangle, K being the matrix of the Laplacian for linear elements.
void add_stiffness(const LocalMesh& mesh, const std::array<LocalIndex, 3>& triangle, const std::vector<double>& u,
                   std::vector<double>& result) {
  std::array<Vec2, 3> side; // opposite of each vertex
  for (std::size_t k = 0; k < 3; ++k)
    side[k] = mesh.points[at(triangle[(k + 2) % 3])] - mesh.points[at(triangle[(k + 1) % 3])];
  const double four_areas = 2 * cross(side[0], side[1]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result[at(triangle[i])] += dot(side[i], side[j]) / four_areas * u[at(triangle[j])];
}

TEST(LocalMesh, TheLaplacianOfALinearFunctionVanishesInside) {
  for_all([](const Case& c, const LocalMesh& mesh, Overlap overlap) {
    if (c.name == "periodic")
      return;
    for (const Vec2 slope : {Vec2{0, 0}, Vec2{3, -2}}) { // of slope 0: the sums of the rows
      std::vector<double> u, result(mesh.points.size(), 0);
      for (const Vec2 p : mesh.points)
        u.push_back(1 + dot(slope, p));
      for (const auto& triangle : mesh.triangles)
        add_stiffness(mesh, triangle, u, result);
      if (overlap == Overlap::none)
        add_to_owners(world(), mesh, result);
      for (LocalIndex i = 0; i < mesh.owned_points; ++i)
        EXPECT_NEAR(mesh.boundary[at(i)] == 0 ? result[at(i)] : 0, 0, 1e-12);
    }
  });
}

} // namespace
} // namespace trime::handover
