// SPDX-License-Identifier: BSD-3-Clause
// The certificate holds for a square with sites in it, and finds what is wrong in the arrays that will be written, or
// in the layout of the boundary: each falsified input fails just the checks that look at it.
#include "certificate/certificate.hpp"

#include "extraction/extraction.hpp"
#include "sites/stage.hpp"
#include "support/distributed.hpp"
#include "support/laid_sites.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace trime::certificate {
namespace {

using geometry::Vec2;
using testing::unit_lattice;

constexpr double h = 0.05;

/// A square, a lattice of sites in it that are moved a little, and the mesh of them.
class Certificate : public ::testing::Test {
protected:
  Certificate()
      : frame(geometry::Box{{0, 0}, {1, 1}}),
        square({shape::Part::rectangle("square", {{0.2, 0.2}, {0.8, 0.8}}, frame)}, "square", frame) {
    stage.scaled_size = std::make_unique<sizing::ScaledSize>(uniform, 1);
    stage.size = std::make_unique<sizing::ScaledSize>(uniform, 1);
    stage.polygon = testing::make_boundary_sites(square.boundary(), uniform, unit_lattice(), 30);
    stage.guard = std::make_unique<polygon::BoundaryGuard>(stage.polygon, unit_lattice());
    stage.state =
        std::make_unique<sites::SiteState>(comm, frame.container(), mesh::GridOptions{{}, {}, h, frame.periods()});
    mesh::SiteList sites;
    for (std::size_t k = 0; k < stage.polygon.sites.size(); ++k)
      sites.push_back({stage.polygon.sites[k].position, static_cast<std::int32_t>(k)});
    for (int j = 1; j < 12; ++j)
      for (int i = 1; i < 12; ++i) {
        const Vec2 shift = testing::random_vec2(7, static_cast<std::uint64_t>(12 * j + i)) - Vec2{0.5, 0.5};
        sites.push_back({unit_lattice().snap(Vec2{0.2 + h * i, 0.2 + h * j} + 0.2 * h * shift)});
      }
    stage.state->distribute(testing::dealt(comm, sites));
    const delaunay::StarBuilder builder(unit_lattice(), 1);
    stage.state->compute_stars(builder, *stage.size, sites::Wanted::all_sites);
    numbering = decomposition::canonical_numbering(comm, stage.state->points(), stage.state->halo());
    mesh = extraction::extract_mesh(
               stage.view(unit_lattice()), numbering, stage.asked_size(),
               polygon::RegionFinder(stage.polygon, square.domain().regions(), square.domain().frame().lattice()))
               .mesh;
  }

  /// Names of the checks that fail.
  std::vector<std::string> failures(const geometry::Boundary& curves) const {
    std::vector<std::string> names;
    for (const mesh::Check& check :
         certify(stage.view(unit_lattice()), numbering, {square.boundary(), curves, stage.asked_size(), 1}, mesh))
      if (!check.passed)
        names.push_back(check.name);
    return names;
  }
  std::vector<std::string> failures() const { return failures(square.boundary()); }

  /// Does something to the mesh on one rank that has enough of it; all ranks learn of it by the sums.
  void on_one_rank(const std::function<void()>& damage) {
    const bool has = mesh.points.size() > 3 && mesh.triangles.size() > 3;
    const std::int64_t first = comm.min(std::int64_t{has ? comm.rank() : comm.size()});
    ASSERT_LT(first, comm.size());
    if (first == comm.rank())
      damage();
  }

  using Names = std::vector<std::string>;
  const comm::Communicator comm = comm::Communicator::world();
  const geometry::Frame frame;
  const shape::RegionShape square;
  const sizing::UniformSize uniform{h};
  sites::Stage stage;
  decomposition::Numbering numbering;
  mesh::DistributedMesh mesh;
};

/// Two points inside that change places.
std::pair<std::size_t, std::size_t> two_inside(const mesh::DistributedMesh& mesh) {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (mesh.boundary[i] == 0)
      inside.push_back(i);
  return {inside.at(0), inside.at(1)};
}

TEST_F(Certificate, HoldsForASoundMesh) {
  EXPECT_EQ(failures(), Names{});
  EXPECT_EQ(mesh.point_slab.total, 48 + 11 * 11);
}

TEST_F(Certificate, FindsPermutedCoordinates) {
  on_one_rank([&] {
    const auto [a, b] = two_inside(mesh);
    std::swap(mesh.points[a], mesh.points[b]);
  });
  EXPECT_EQ(failures(), Names{"written_points"});
}

TEST_F(Certificate, FindsACoordinateThatIsRoundedOtherwise) {
  on_one_rank([&] {
    double& x = mesh.points[two_inside(mesh).first].x;
    x = std::nextafter(x, 2);
  });
  EXPECT_EQ(failures(), Names{"written_points"});
}

TEST_F(Certificate, FindsATriangleWithAnotherVertex) {
  on_one_rank([&] { std::swap(mesh.triangles[1][1], mesh.triangles[1][2]); });
  EXPECT_EQ(failures(), Names{"written_triangles"});
}

TEST_F(Certificate, FindsAMissingCorner) {
  // Curves with one corner more than the boundary was laid out with: a vertex beside the middle of the first side.
  geometry::Boundary curves = square.boundary();
  std::vector<geometry::Piece>& pieces = curves.loops[0].pieces;
  geometry::Piece first = pieces[0], second = pieces[0];
  first.end = second.start = unit_lattice().snap(0.5 * (first.start + first.end) + Vec2{0.2, 0.2});
  pieces[0] = first;
  pieces.insert(pieces.begin() + 1, second);
  const Names failed = failures(curves);
  EXPECT_TRUE(std::find(failed.begin(), failed.end(), "turns_kept") != failed.end());
  EXPECT_TRUE(std::find(failed.begin(), failed.end(), "corners") == failed.end()) << "which asks the layout alone";
}

TEST_F(Certificate, AsksNoFlagOfTheLayoutWhereCornersAre) {
  for (polygon::BoundarySite& site : stage.polygon.sites)
    site.corner = false;
  stage.polygon.corners = 0;
  const Names failed = failures();
  EXPECT_TRUE(std::find(failed.begin(), failed.end(), "turns_kept") == failed.end());
}

} // namespace
} // namespace trime::certificate
