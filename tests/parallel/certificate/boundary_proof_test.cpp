// SPDX-License-Identifier: BSD-3-Clause
// The proof of the boundary finds what is wrong: each falsified input fails just the checks that look at it.
#include "certificate/boundary_proof.hpp"
#include "support/laid_sites.hpp"

#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace trime::certificate {
namespace {

using geometry::Frame;
using geometry::Vec2;
using polygon::BoundarySite;
using polygon::BoundarySites;
using shape::Part;
using shape::RegionShape;
using testing::make_boundary_sites;

/// A disc with a hole and its boundary edges, point k being site k; shared out over the ranks.
class BoundaryProof : public ::testing::Test {
protected:
  BoundaryProof()
      : frame(geometry::Box{{0, 0}, {1, 1}}), shape(ring(0.4)), boundary(shape.boundary()), other(ring(0.41)),
        sites(make_boundary_sites(boundary, size, frame.lattice(), 30)) {}

  RegionShape ring(double radius) const {
    return {{Part::circle("disc", {0.5, 0.5}, radius, frame), Part::circle("hole", {0.55, 0.5}, 0.15, frame)},
            "difference(disc, hole)",
            frame};
  }

  /// Facet k leads from site k to its next; ranks hold equal shares in order.
  mesh::DistributedMesh mesh_of_sites() const {
    const auto n = static_cast<LocalIndex>(sites.sites.size());
    const LocalIndex first = n * comm.rank() / comm.size(), end = n * (comm.rank() + 1) / comm.size();
    mesh::DistributedMesh mesh;
    for (LocalIndex k = first; k < end; ++k) {
      const BoundarySite& site = sites.sites[static_cast<std::size_t>(k)];
      mesh.points.push_back(site.position);
      mesh.boundary.push_back(site.tag);
      mesh.facets.push_back({k, site.next});
      mesh.facet_tags.push_back(site.tag);
      mesh.facet_parts.push_back(site.part);
      mesh.facet_sizes.push_back(1);
    }
    mesh.point_slab = mesh.facet_slab = {first, n};
    return mesh;
  }

  double area() const {
    double twice = 0;
    for (LocalIndex k = 0; k < std::ssize(sites.sites); ++k)
      twice += cross(sites.chord(k).a, sites.chord(k).b);
    return 0.5 * twice;
  }

  BoundaryTruth truth() const { return {boundary, boundary, sites, size, size, frame.lattice(), 1, area()}; }

  /// Names of the checks that fail, in order.
  std::vector<std::string> failures(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh) const {
    std::vector<std::string> names;
    for (const mesh::Check& check : prove_boundary(truth, mesh, comm))
      if (!check.passed)
        names.push_back(check.name);
    return names;
  }

  using Names = std::vector<std::string>;
  const comm::Communicator comm = comm::Communicator::world();
  const Frame frame;
  const RegionShape shape;
  const geometry::Boundary boundary;
  const RegionShape other;
  const sizing::UniformSize size{0.05};
  BoundarySites sites;
};

TEST_F(BoundaryProof, PassesWhatIsRight) {
  const mesh::Checks checks = prove_boundary(truth(), mesh_of_sites(), comm);
  ASSERT_EQ(checks.size(), 9u);
  for (const mesh::Check& check : checks)
    EXPECT_TRUE(check.passed) << check.name << " " << check.found;
  EXPECT_LT(checks[8].found, 1e-13) << "the area, but for rounding";
  EXPECT_GT(checks[6].found, 0.04) << "the hole strays from its edges";
}

TEST_F(BoundaryProof, FindsWrongEdges) {
  mesh::DistributedMesh mesh = mesh_of_sites();
  if (!mesh.facets.empty() && comm.rank() == comm.size() - 1)
    mesh.facets.back()[1] += 1;
  EXPECT_EQ(failures(truth(), mesh), (Names{"irregular_boundary_points", "boundary_cycles"}));
  mesh = mesh_of_sites();
  if (comm.rank() == comm.size() / 2)
    mesh.facet_tags.front() = 7;
  EXPECT_EQ(failures(truth(), mesh), Names{"foreign_tags"});
  mesh = mesh_of_sites();
  const auto hole = static_cast<GlobalId>(sites.loop_start[1]);
  std::erase_if(mesh.facets, [&](const auto& facet) { return facet[0] >= hole; });
  EXPECT_EQ(failures(truth(), mesh), Names{"boundary_cycles"}) << "a hole that the mesh does not have";
}

TEST_F(BoundaryProof, FindsLoopsThatExchangeTheirTags) {
  mesh::DistributedMesh mesh = mesh_of_sites();
  for (std::int32_t& tag : mesh.facet_tags)
    tag = 1 - tag + 2 * boundary.loops.front().tag; // of the other loop, if the tags follow on each other
  ASSERT_EQ(boundary.loops[1].tag, boundary.loops[0].tag + 1);
  EXPECT_EQ(failures(truth(), mesh), Names{}) << "the same tags, each on a loop of its own";
  for (std::int32_t& tag : mesh.facet_tags)
    tag = boundary.loops.front().tag;
  EXPECT_EQ(failures(truth(), mesh), Names{"foreign_tags"}) << "both loops have one tag";
}

TEST_F(BoundaryProof, FindsVerticesBesideTheCurve) {
  mesh::DistributedMesh mesh = mesh_of_sites();
  if (comm.rank() == comm.size() - 1)
    mesh.points.back().x += 1e-8;
  EXPECT_EQ(failures(truth(), mesh), Names{"vertex_distance"});
  mesh = mesh_of_sites();
  if (comm.rank() == comm.size() - 1)
    mesh.points.back().x += 1e-10;
  EXPECT_EQ(failures(truth(), mesh), Names{});
  sites.sites[3].along += 1e-8;
  EXPECT_EQ(failures(truth(), mesh), Names{"vertex_distance"}) << "a site that is not at its place";
  const BoundaryTruth larger{other.boundary(), boundary, sites, size, size, frame.lattice(), 1, area()};
  EXPECT_EQ(failures(larger, mesh), Names{"vertex_distance"}) << "the shape is another one";
}

TEST_F(BoundaryProof, FindsACornerThatMovedByOneStep) {
  const RegionShape triangle({Part::triangle("t", {Vec2{0.1, 0.1}, {0.9, 0.2}, {0.4, 0.8}}, frame)}, "t", frame);
  sites = make_boundary_sites(triangle.boundary(), size, frame.lattice(), 30);
  BoundaryTruth truth{triangle.boundary(), triangle.boundary(), sites, size, size, frame.lattice(), 1, area()};
  EXPECT_EQ(failures(truth, mesh_of_sites()), Names{});
  const auto corner = std::find_if(sites.sites.begin() + 1, sites.sites.end(), [](const auto& s) { return s.corner; });
  corner->position.x += frame.step();
  truth.mesh_area = area();
  EXPECT_EQ(failures(truth, mesh_of_sites()), Names{"corner_places"});
}

TEST_F(BoundaryProof, FindsChordsThatLeaveTheCurve) {
  const mesh::DistributedMesh mesh = mesh_of_sites();
  const sizing::UniformSize tiny(1e-4);
  const BoundaryTruth fine{boundary, boundary, sites, size, tiny, frame.lattice(), 1, area()};
  EXPECT_EQ(failures(fine, mesh), Names{"chord_deviation"}) << "edges far longer than h";
  const BoundaryTruth lowered{boundary, boundary, sites, tiny, size, frame.lattice(), 1, area()};
  EXPECT_EQ(failures(lowered, mesh), Names{})
      << "the size was lowered: corners are left out by shares of the asked one";
  // The curve goes all the way round from one site to its next.
  BoundarySites turned = sites;
  std::swap(turned.sites[1].position, turned.sites[2].position);
  std::swap(turned.sites[1].along, turned.sites[2].along);
  std::swap(turned.sites[1].piece, turned.sites[2].piece);
  const BoundaryTruth round{boundary, boundary, turned, size, size, frame.lattice(), 1, area()};
  const Names found = failures(round, mesh);
  EXPECT_NE(std::find(found.begin(), found.end(), "chord_deviation"), found.end());
  EXPECT_NE(std::find(found.begin(), found.end(), "arc_deviation"), found.end());
}

TEST_F(BoundaryProof, FindsAreaThatChordsDoNotExplain) {
  const mesh::DistributedMesh mesh = mesh_of_sites();
  const double shape_area = boundary.area;
  BoundaryTruth wrong{boundary, boundary, sites, size, size, frame.lattice(), 1, area() + 2e-10 * shape_area};
  EXPECT_EQ(failures(wrong, mesh), Names{"area_residual"});
  wrong.mesh_area = area() + 0.5e-10 * shape_area;
  EXPECT_EQ(failures(wrong, mesh), Names{});
  const BoundaryTruth larger{boundary, other.boundary(), sites, size, size, frame.lattice(), 1, area()};
  const Names found = failures(larger, mesh);
  EXPECT_NE(std::find(found.begin(), found.end(), "vertex_distance"), found.end());
}

} // namespace
} // namespace trime::certificate
