// SPDX-License-Identifier: BSD-3-Clause
// The cells of whole meshes on any number of ranks: the same as on one rank, shared vertices, and what the proof finds.
#include "dual/proof.hpp"

#include "comm/agree.hpp"
#include "support/mesh_slabs.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace trime::dual {
namespace {

using geometry::Vec2;

/// One corner, as all ranks together make it.
struct Corner {
  GlobalId site;
  std::int64_t region;
  GlobalId vertex;
  Vec2 place; // in the frame of the mesh
};

std::vector<Corner> all_corners(const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  const Cells cells = make_cells(mesh, {0, 0}, comm);
  const CellVertices vertices(cells, comm);
  std::vector<Corner> corners;
  Surroundings around;
  for (LocalIndex site = 0; site < cells.site_count; ++site) {
    look_around(cells, site, around);
    for (const CellPart& part : parts_of(around))
      for (const CellCorner& corner : vertices.corners(around, site, part))
        corners.push_back({cells.number_of(site), part.region, corner.vertex, cells.points[at(site)] + corner.place});
  }
  return comm::gather_everywhere(comm, corners);
}

TEST(Cells, AreTheSameOnAnyRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const bool has_regions : {false, true}) {
    const mesh::DistributedMesh whole = has_regions ? test::divided_square(5) : test::holed_square(5);
    const std::vector<Corner> one = all_corners(whole, comm::Communicator::self());
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      const std::vector<Corner> many = all_corners(test::slabs_of(whole, comm, seed), comm);
      ASSERT_EQ(many.size(), one.size());
      for (std::size_t k = 0; k < one.size(); ++k) {
        EXPECT_EQ(many[k].site, one[k].site);
        EXPECT_EQ(many[k].region, one[k].region);
        EXPECT_EQ(many[k].vertex, one[k].vertex);
        EXPECT_EQ(many[k].place, one[k].place);
      }
    }
  }
}

TEST(Cells, ShareVerticesAtOnePlaceAndUseAllOfThem) {
  const comm::Communicator comm = comm::Communicator::world();
  const mesh::DistributedMesh part = test::slabs_of(test::divided_square(7), comm, 2);
  const Cells cells = make_cells(part, {0, 0}, comm);
  const CellVertices vertices(cells, comm);
  std::map<GlobalId, Vec2> places;
  for (const Corner& corner : all_corners(part, comm)) {
    const auto [known, is_new] = places.insert({corner.vertex, corner.place});
    EXPECT_NEAR(length(known->second - corner.place), 0, 1e-15) << corner.vertex;
  }
  ASSERT_EQ(std::ssize(places), vertices.count());
  EXPECT_EQ(places.begin()->first, 0);
  EXPECT_EQ(places.rbegin()->first, vertices.count() - 1);
  EXPECT_EQ(vertices.count(CellVertices::facet_middles), part.facet_slab.total);
  EXPECT_EQ(vertices.count(CellVertices::interface_middles), part.interface_slab.total);
  for (const auto group : {CellVertices::facet_middles, CellVertices::boundary_sites, CellVertices::interface_middles,
                           CellVertices::interface_sites})
    for (std::size_t row = 0; row < vertices.places(group).size(); ++row)
      EXPECT_EQ(places.at(vertices.first(group) + static_cast<GlobalId>(row)), vertices.places(group)[row]);
}

std::set<std::string> failed(const CellProof& proof) {
  std::set<std::string> names;
  for (const mesh::Check& check : proof.checks)
    if (!check.passed)
      names.insert(check.name);
  return names;
}

CellProof proof_of(const mesh::DistributedMesh& whole, const comm::Communicator& comm) {
  const mesh::DistributedMesh part = test::slabs_of(whole, comm, 3);
  return prove(part, make_cells(part, {0, 0}, comm), 3, comm);
}

TEST(CellProof, PassesSquaresWithHolesAndRegions) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const auto& whole : {test::holed_square(3), test::holed_square(9), test::divided_square(9)}) {
    const CellProof proof = proof_of(whole, comm);
    EXPECT_EQ(failed(proof), std::set<std::string>{});
    EXPECT_EQ(proof.facts.cells, whole.point_slab.total);
    EXPECT_EQ(proof.facts.boundary_cells, whole.facet_slab.total);
    const CellProof one = proof_of(whole, comm::Communicator::self());
    EXPECT_EQ(proof.facts.area, one.facts.area);
    EXPECT_EQ(proof.facts.smallest_area, one.facts.smallest_area);
    EXPECT_EQ(proof.facts.shortest_dual_edge, one.facts.shortest_dual_edge);
  }
}

/// A strip of congruent triangles along the diagonal of a square; those at its upper side have another region.
mesh::DistributedMesh diagonal_strip(int pairs) {
  const double step = std::ldexp(1.0, -15);
  mesh::DistributedMesh mesh;
  std::vector<std::array<GlobalId, 3>> triangles;
  for (int k = 0; k < pairs; ++k) {
    mesh.points.push_back({k * step, k * step});
    mesh.points.push_back({(k + 1.375) * step, (k - 0.375) * step});
    if (const GlobalId a = 2 * k, b = a + 1; k + 1 < pairs) {
      triangles.push_back({a, b, a + 2});
      triangles.push_back({b, b + 2, a + 2});
      mesh.region.insert(mesh.region.end(), {1, 2});
      mesh.facets.push_back({a + 2, a});
      mesh.facets.push_back({b, b + 2});
    }
  }
  const GlobalId last = 2 * pairs - 2;
  mesh.facets.push_back({0, 1});
  mesh.facets.push_back({last + 1, last});
  mesh.point_slab.total = std::ssize(mesh.points);
  mesh.triangle_slab.total = std::ssize(triangles);
  mesh.facet_slab.total = std::ssize(mesh.facets);
  assign_triangles(mesh, triangles);
  return mesh;
}

/// The few different areas in such a mesh have roundings that would add up, as they did in a square of 10^7 points.
TEST(CellProof, RoundingsOfEqualAreasDoNotAddUp) {
  const comm::Communicator self = comm::Communicator::self();
  for (const int pairs : {17500, 17750, 18500, 19250}) { // boxes of different areas, so units of different sizes
    const mesh::DistributedMesh strip = diagonal_strip(pairs);
    const CellProof proof = prove(strip, make_cells(strip, {0, 0}, self), 2, self);
    EXPECT_EQ(failed(proof), std::set<std::string>{}) << pairs;
  }
}

TEST(CellProof, FindsCircumcentresOutsideAndCellsThatOverlap) {
  const comm::Communicator comm = comm::Communicator::world();
  mesh::DistributedMesh sheared = test::holed_square(5);
  for (Vec2& p : sheared.points)
    p.x += 0.5 * p.y; // the diagonals become the long ones
  const std::set<std::string> names = failed(proof_of(sheared, comm));
  EXPECT_TRUE(names.contains("negative_dual_edges"));
  EXPECT_FALSE(names.contains("cell_euler"));
  mesh::DistributedMesh flat = test::holed_square(3);
  for (Vec2& p : flat.points)
    p.x -= 2 * p.y;
  EXPECT_TRUE(failed(proof_of(flat, comm)).contains("circumcentres_outside"));
}

TEST(Cells, RefuseAPointWhoseTrianglesAreNotOneFan) {
  const comm::Communicator comm = comm::Communicator::world();
  mesh::DistributedMesh whole = test::holed_square(3);
  std::vector<std::array<GlobalId, 3>> ids = global_triangles(whole);
  ids.erase(ids.begin() + 1); // at a corner of the hole, which has triangles on both sides of it
  assign_triangles(whole, ids);
  whole.region.resize(ids.size());
  whole.alpha.resize(ids.size());
  whole.beta.resize(ids.size());
  whole.triangle_slab.total = std::ssize(ids);
  EXPECT_THROW(make_cells(test::slabs_of(whole, comm, 1), {0, 0}, comm), FileError);
}

} // namespace
} // namespace trime::dual
