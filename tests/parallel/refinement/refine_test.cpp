// SPDX-License-Identifier: BSD-3-Clause
// Refined meshes: the same on any number of ranks, however the mesh is divided among them, empty ranks included.
#include "trime/refinement/refine.hpp"

#include "support/distributed.hpp"
#include "support/mesh_slabs.hpp"
#include "support/periodic_shapes.hpp"
#include "support/plain_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace trime::refinement {
namespace {

using mesh::DistributedMesh;

/// Never freed: MPI is finalised before statics are.
const comm::Communicator& world() {
  static const comm::Communicator& world = *new comm::Communicator(comm::Communicator::world());
  return world;
}

std::string failed(const mesh::Checks& checks) {
  std::string names;
  for (const mesh::Check& check : checks)
    if (!check.passed)
      names += fmt::format("{}: {} instead of {}; ", check.name, check.found, check.expected);
  return names;
}

/// Compares this rank's part with the same rows of the whole mesh.
void expect_part(const DistributedMesh& part, const DistributedMesh& whole) {
  EXPECT_EQ(part.hash, whole.hash);
  EXPECT_EQ(part.point_slab.total, whole.point_slab.total);
  EXPECT_EQ(part.triangle_slab.total, whole.triangle_slab.total);
  EXPECT_EQ(part.facet_slab.total, whole.facet_slab.total);
  const auto same = [](const auto& mine, const auto& all, const mesh::Slab& slab) {
    return mine == test::cut(all, slab, std::ssize(mine));
  };
  EXPECT_TRUE(same(part.points, whole.points, part.point_slab));
  EXPECT_TRUE(same(part.boundary, whole.boundary, part.point_slab));
  EXPECT_TRUE(same(part.size, whole.size, part.point_slab));
  EXPECT_TRUE(same(part.fixed, whole.fixed, part.point_slab));
  EXPECT_TRUE(same(part.alpha, whole.alpha, part.triangle_slab));
  EXPECT_TRUE(same(part.facets, whole.facets, part.facet_slab));
  EXPECT_TRUE(same(part.facet_tags, whole.facet_tags, part.facet_slab));
  EXPECT_TRUE(same(part.facet_parts, whole.facet_parts, part.facet_slab));
  EXPECT_TRUE(same(part.facet_sizes, whole.facet_sizes, part.facet_slab));
  EXPECT_EQ(part.curve_slab.total, whole.curve_slab.total);
  EXPECT_EQ(part.interface_slab.total, whole.interface_slab.total);
  EXPECT_TRUE(same(part.curve_edges, whole.curve_edges, part.curve_slab));
  EXPECT_TRUE(same(part.curve_numbers, whole.curve_numbers, part.curve_slab));
  EXPECT_TRUE(same(part.interfaces, whole.interfaces, part.interface_slab));
  EXPECT_TRUE(same(part.interface_regions, whole.interface_regions, part.interface_slab));
  EXPECT_TRUE(same(part.interface_pairs, whole.interface_pairs, part.interface_slab));
  EXPECT_TRUE(same(part.interface_curves, whole.interface_curves, part.interface_slab));
  if (!part.region.empty()) {
    EXPECT_TRUE(same(part.region, whole.region, part.triangle_slab));
  }
  for (std::size_t t = 0; t < part.triangles.size(); ++t)
    EXPECT_EQ(part.triangle_ids(t), whole.triangle_ids(static_cast<std::size_t>(part.triangle_slab.first) + t));
}

void expect_same(const DistributedMesh& whole, const DistributedMesh& part, const Surroundings& surroundings) {
  const Refined expected = refine(comm::Communicator::self(), whole, surroundings);
  const Refined found = refine(world(), part, surroundings);
  EXPECT_EQ(failed(expected.checks), "");
  EXPECT_EQ(failed(found.checks), "");
  expect_part(found.mesh, expected.mesh);
  EXPECT_EQ(found.quality.alpha.mean, expected.quality.alpha.mean);
  EXPECT_EQ(found.quality.size_mean, expected.quality.size_mean);
  EXPECT_EQ(found.middles.on_curve, expected.middles.on_curve);
  EXPECT_EQ(2 * (found.middles.on_curve + found.middles.straight + found.middles.refused),
            expected.mesh.facet_slab.total);
  ASSERT_EQ(found.regions.size(), expected.regions.size());
  for (std::size_t k = 0; k < found.regions.size(); ++k) {
    EXPECT_EQ(found.regions[k].triangles, expected.regions[k].triangles);
    EXPECT_EQ(found.regions[k].area, expected.regions[k].area);
  }
  ASSERT_EQ(found.loops.size(), expected.loops.size());
  for (std::size_t k = 0; k < found.loops.size(); ++k)
    EXPECT_EQ(found.loops[k].length, expected.loops[k].length);
}

TEST(Refine, GivesTheSameMeshFromAnySlabs) {
  const geometry::Frame frame(geometry::unit_square);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    DistributedMesh whole = test::holed_square(seed % 2 == 0 ? 3 : 11);
    for (geometry::Vec2& p : whole.points)
      p = frame.lattice().snap(p);
    expect_same(whole, test::slabs_of(whole, world(), seed), {frame});
  }
}

void expect_same(const geometry::Domain& domain) {
  meshing::MeshOptions options;
  options.points = 400;
  const sizing::UniformSize size;
  const DistributedMesh whole = testing::mesh_silently(comm::Communicator::self(), domain, size, options).mesh;
  const DistributedMesh part = testing::mesh_silently(world(), domain, size, options).mesh;
  expect_same(whole, part, {domain.frame(), &domain.boundary()});
}

TEST(Refine, FollowsTheCurvesOnAnyRanks) {
  expect_same(testing::disc_with_hole().domain());
}

TEST(Refine, DividesTrianglesAcrossTheBorder) {
  for (const shape::RegionShape& shape : testing::periodic_shapes())
    expect_same(shape.domain());
}

TEST(Refine, KeepsRegions) {
  const geometry::Frame frame(geometry::unit_square);
  DistributedMesh whole = test::holed_square(5);
  for (std::size_t t = 0; t < whole.region.size(); ++t)
    whole.region[t] = 1 + static_cast<std::int32_t>(t % 3);
  const Refined refined = refine(comm::Communicator::self(), whole, {frame});
  std::array<std::int64_t, 4> before{}, after{};
  for (const std::int32_t region : whole.region)
    ++before[static_cast<std::size_t>(region)];
  for (const std::int32_t region : refined.mesh.region)
    ++after[static_cast<std::size_t>(region)];
  for (std::size_t k = 0; k < before.size(); ++k)
    EXPECT_EQ(after[k], 4 * before[k]);
}

TEST(Refine, GivesTheSameInterfacesFromAnySlabs) {
  const geometry::Frame frame(geometry::unit_square);
  for (const std::uint64_t seed : {1, 2, 3}) {
    DistributedMesh whole = test::divided_square(seed % 2 == 0 ? 3 : 11);
    for (geometry::Vec2& p : whole.points)
      p = frame.lattice().snap(p);
    expect_same(whole, test::slabs_of(whole, world(), seed), {frame});
  }
}

TEST(Refine, HalvesInterfacesAndKeepsTheirSides) {
  const geometry::Frame frame(geometry::unit_square);
  DistributedMesh whole = test::divided_square(7);
  for (geometry::Vec2& p : whole.points)
    p = frame.lattice().snap(p);
  const Refined refined = refine(comm::Communicator::self(), whole, {frame});
  const DistributedMesh& mesh = refined.mesh;
  EXPECT_EQ(mesh.interface_slab.total, 2 * whole.interface_slab.total);
  EXPECT_EQ(mesh.curve_slab.total, 2 * whole.curve_slab.total);
  std::map<std::array<GlobalId, 2>, std::int32_t> region_of; // on the left of a side
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      region_of[{mesh.triangle_ids(t)[k], mesh.triangle_ids(t)[(k + 1) % 3]}] = mesh.region[t];
  for (std::size_t k = 0; k < mesh.interfaces.size(); ++k) {
    const auto [a, b] = mesh.interfaces[k];
    EXPECT_EQ((region_of[{a, b}]), mesh.interface_regions[k][0]);
    EXPECT_EQ((region_of[{b, a}]), mesh.interface_regions[k][1]);
    EXPECT_EQ(mesh.interface_pairs[k], mesh.interface_regions[k][0] + mesh.interface_regions[k][1] - 3);
    EXPECT_EQ(mesh.interface_curves[k], mesh.interface_pairs[k] == 0 ? 0 : -1);
  }
  ASSERT_EQ(refined.regions.size(), 3u);
  EXPECT_EQ(refined.regions[1].triangles, std::count(mesh.region.begin(), mesh.region.end(), 2));
  const auto has_interfaces = [](const mesh::Check& check) { return check.name == "interfaces" && check.passed; };
  EXPECT_EQ(std::count_if(refined.checks.begin(), refined.checks.end(), has_interfaces), 1);
}

TEST(Refine, TwiceHalvesEdgesTwice) {
  const geometry::Frame frame(geometry::unit_square);
  const DistributedMesh whole = test::holed_square(3);
  const Refined once = refine(world(), test::slabs_of(whole, world(), 7), {frame});
  const Refined twice = refine(world(), once.mesh, {frame});
  EXPECT_EQ(twice.mesh.triangle_slab.total, 16 * whole.triangle_slab.total);
  EXPECT_EQ(twice.mesh.facet_slab.total, 4 * whole.facet_slab.total);
  for (const float size : twice.mesh.size)
    EXPECT_FLOAT_EQ(size, whole.size[0] / 4);
}

} // namespace
} // namespace trime::refinement
