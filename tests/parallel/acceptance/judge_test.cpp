// SPDX-License-Identifier: BSD-3-Clause
// Each rule of the solvers on a small mesh that breaks it, divided among any number of ranks.
#include "acceptance/judge.hpp"

#include "support/mesh_slabs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace trime::acceptance {
namespace {

using geometry::Vec2;
using Ids = std::array<GlobalId, 3>;
using Edge = std::array<GlobalId, 2>;

constexpr std::array all_solvers{Solver::adcirc, Solver::schism,  Solver::telemac,
                                 Solver::fvcom,  Solver::delft3d, Solver::mpas};

void sort_triangles(std::vector<Ids>& triangles) {
  for (Ids& ids : triangles)
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
  std::sort(triangles.begin(), triangles.end());
}

/// A whole mesh. @param open boundary edges of part 1; all others belong to part 0
mesh::DistributedMesh mesh_of(const std::vector<Vec2>& points, std::vector<Ids> triangles,
                              const std::set<Edge>& open = {}) {
  mesh::DistributedMesh mesh;
  mesh.points.assign(points.begin(), points.end());
  sort_triangles(triangles);
  std::set<Edge> edges;
  for (const Ids& ids : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert({ids[k], ids[(k + 1) % 3]});
  mesh.boundary.resize(points.size(), 0);
  for (const Edge& edge : edges)
    if (!edges.contains({edge[1], edge[0]})) {
      mesh.facets.push_back(edge);
      mesh.facet_tags.push_back(1);
      mesh.facet_parts.push_back(open.contains(edge) ? 1 : 0);
      mesh.facet_sizes.push_back(1);
      mesh.boundary[static_cast<std::size_t>(edge[0])] = 1;
    }
  mesh.size.resize(points.size(), 1);
  mesh.fixed.resize(points.size(), 0);
  mesh.point_slab.total = std::ssize(points);
  assign_triangles(mesh, triangles);
  mesh.triangle_slab.total = std::ssize(triangles);
  mesh.facet_slab.total = std::ssize(mesh.facets);
  mesh.alpha.resize(triangles.size(), 1);
  mesh.beta.resize(triangles.size(), 1);
  mesh.region.resize(triangles.size(), 1);
  return mesh;
}

/// A regular polygon around a point, cut into n triangles. The point has the number 0.
mesh::DistributedMesh wheel(int n) {
  std::vector<Vec2> points{{3, 4}};
  std::vector<Ids> triangles;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    points.push_back({3 + std::cos(angle), 4 + std::sin(angle)});
    triangles.push_back({0, k + 1, (k + 1) % n + 1});
  }
  return mesh_of(points, triangles);
}

/// The verdict of the rule with this measure and limit, which is the same however the ranks share the mesh.
Verdict judged(const mesh::DistributedMesh& whole, Solver solver, Measure measure, bool is_least, double limit,
               const BoundaryFacts& facts = {}) {
  const comm::Communicator comm = comm::Communicator::world();
  Verdict found;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const std::vector<Verdict> verdicts = judge(test::slabs_of(whole, comm, seed), all_solvers, facts, comm);
    EXPECT_EQ(verdicts.size(), solver_rules().size());
    const auto its = std::find_if(verdicts.begin(), verdicts.end(), [&](const Verdict& verdict) {
      const SolverRule& rule = verdict.rule;
      return rule.solver == solver && rule.measure == measure && rule.is_least == is_least && rule.limit == limit;
    });
    EXPECT_NE(its, verdicts.end());
    if (its == verdicts.end())
      return found;
    if (seed > 0) {
      EXPECT_EQ(its->worst, found.worst);
      EXPECT_EQ(its->broken, found.broken);
      EXPECT_EQ(its->has_place(), found.has_place());
      EXPECT_TRUE(!its->has_place() || its->place == found.place);
    }
    found = *its;
  }
  return found;
}

TEST(Judge, FindsNoFaultInAHexagon) {
  const comm::Communicator comm = comm::Communicator::world();
  const std::vector<Verdict> verdicts = judge(test::slabs_of(wheel(6), comm, 1), all_solvers, {}, comm);
  EXPECT_EQ(verdicts.size(), solver_rules().size());
  for (const Verdict& verdict : verdicts)
    EXPECT_TRUE(verdict.holds()) << text_of(verdict, false);
}

TEST(Judge, JudgesOnlyForTheSolversThatAreNamed) {
  const comm::Communicator comm = comm::Communicator::world();
  const std::array twice{Solver::mpas, Solver::mpas};
  const std::vector<Verdict> verdicts = judge(test::slabs_of(wheel(6), comm, 1), twice, {}, comm);
  EXPECT_EQ(std::ssize(verdicts), std::ranges::count(solver_rules(), Solver::mpas, &SolverRule::solver));
  for (const Verdict& verdict : verdicts)
    EXPECT_EQ(verdict.rule.solver, Solver::mpas);
  EXPECT_TRUE(judge(test::slabs_of(wheel(6), comm, 1), {}, {}, comm).empty());
}

TEST(Judge, CountsTrianglesAtAPoint) {
  const Verdict adcirc = judged(wheel(10), Solver::adcirc, Measure::triangles_at_point, false, 9);
  EXPECT_EQ(adcirc.broken, 1);
  EXPECT_EQ(adcirc.worst, 10);
  EXPECT_EQ(adcirc.place, (Vec2{3, 4}));
  EXPECT_EQ(judged(wheel(9), Solver::adcirc, Measure::triangles_at_point, false, 9).broken, 0);
  EXPECT_EQ(judged(wheel(9), Solver::fvcom, Measure::triangles_at_point, false, 8).broken, 1);
  EXPECT_EQ(judged(wheel(8), Solver::mpas, Measure::cell_edges, false, 7).broken, 1);
  const Verdict square = judged(wheel(4), Solver::mpas, Measure::cell_edges, true, 5);
  EXPECT_EQ(square.broken, 1);
  EXPECT_EQ(square.worst, 4);
}

TEST(Judge, MeasuresAnglesAndSkewness) {
  // A needle of 5 degrees: its long sides are 1.
  const double angle = 5 * std::numbers::pi / 180;
  const mesh::DistributedMesh needle = mesh_of({{0, 0}, {1, 0}, {std::cos(angle), std::sin(angle)}}, {{0, 1, 2}});
  const Verdict least = judged(needle, Solver::adcirc, Measure::least_angle, true, 10);
  EXPECT_EQ(least.broken, 1);
  EXPECT_NEAR(least.worst, 5, 1e-9);
  EXPECT_EQ(judged(needle, Solver::fvcom, Measure::least_angle, true, 30).broken, 1);
  const Verdict skew = judged(needle, Solver::schism, Measure::skewness, false, 15);
  EXPECT_EQ(skew.broken, 0);
  EXPECT_NEAR(skew.worst, 1 / std::sqrt(0.5 * std::sin(angle) / std::numbers::pi), 1e-9);
  const mesh::DistributedMesh flat = mesh_of({{0, 0}, {2, 0}, {1, 0.01}}, {{0, 1, 2}});
  EXPECT_EQ(judged(flat, Solver::schism, Measure::skewness, false, 15).broken, 1);
  EXPECT_EQ(judged(flat, Solver::adcirc, Measure::largest_angle, false, 150).broken, 1);
  EXPECT_EQ(judged(flat, Solver::fvcom, Measure::largest_angle, false, 130).broken, 1);
  EXPECT_EQ(judged(wheel(3), Solver::mpas, Measure::largest_angle, false, 90).broken, 3);
}

TEST(Judge, SeesTrianglesWithTwoAndThreeBoundaryEdges) {
  const mesh::DistributedMesh alone = mesh_of({{0, 0}, {1, 0}, {0.5, 0.8}}, {{0, 1, 2}});
  EXPECT_EQ(judged(alone, Solver::schism, Measure::boundary_edges, false, 2).worst, 3);
  const mesh::DistributedMesh square = mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const Verdict ears = judged(square, Solver::fvcom, Measure::boundary_edges, false, 1);
  EXPECT_EQ(ears.broken, 2);
  EXPECT_EQ(ears.worst, 2);
  EXPECT_NEAR(ears.place.x, 2 / 3.0, 1e-15); // of two equally bad triangles, the first one
  const Verdict corners = judged(square, Solver::telemac, Measure::boundary_corners, false, 2);
  EXPECT_EQ(corners.broken, 2);
  EXPECT_EQ(corners.ears, 2);
  EXPECT_NE(text_of(corners, false).find("split_ears"), std::string::npos);
  EXPECT_EQ(text_of(corners, true).find("split_ears"), std::string::npos);
  EXPECT_EQ(judged(alone, Solver::telemac, Measure::boundary_corners, false, 2).ears, 0);
  EXPECT_EQ(judged(square, Solver::schism, Measure::boundary_edges, false, 2).broken, 0);
}

TEST(Judge, AddsUpMarksOfOpenAndClosedBoundaries) {
  const std::vector<Vec2> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<Ids> triangles{{0, 1, 2}, {0, 2, 3}};
  const BoundaryFacts facts{{}, 1, 1, 0, {false, true}};
  const auto marks = [&](const std::set<Edge>& open) {
    return judged(mesh_of(corners, triangles, open), Solver::fvcom, Measure::boundary_marks, false, 4, facts);
  };
  EXPECT_EQ(marks({}).worst, 3);
  EXPECT_EQ(marks({}).broken, 0);
  EXPECT_EQ(marks({{0, 1}}).worst, 5); // an open side and one on land
  EXPECT_EQ(marks({{0, 1}}).broken, 1);
  EXPECT_EQ(marks({{0, 1}, {1, 2}}).worst, 6); // two open sides
  EXPECT_TRUE(marks({{0, 1}}).rule.refuses);
}

TEST(Judge, SeesBoundariesThatTouchInAPoint) {
  const mesh::DistributedMesh bow = mesh_of({{-1, -1}, {-1, 1}, {0, 0}, {1, -1}, {1, 1}}, {{0, 2, 1}, {2, 3, 4}});
  for (const Solver solver : {Solver::adcirc, Solver::schism, Solver::telemac, Solver::fvcom}) {
    const Verdict touch = judged(bow, solver, Measure::boundary_paths, false, 1);
    EXPECT_EQ(touch.broken, 1);
    EXPECT_EQ(touch.worst, 2);
    EXPECT_EQ(touch.place, (Vec2{0, 0}));
  }
}

TEST(Judge, ComparesNeighbours) {
  // The triangles across the side from (0, 0) to (0, 1) have the areas 0.5 and 0.2.
  const mesh::DistributedMesh pair = mesh_of({{0, 0}, {0, 1}, {-1, 0.5}, {0.4, 0.5}}, {{0, 1, 2}, {0, 3, 1}});
  const Verdict share = judged(pair, Solver::fvcom, Measure::area_share, true, 0.5);
  EXPECT_EQ(share.measured, 1);
  EXPECT_EQ(share.broken, 1);
  EXPECT_NEAR(share.worst, 0.4, 1e-15);
  EXPECT_EQ(share.place, (Vec2{0, 0.5}));
}

TEST(Judge, MeasuresFlowLinksAsDFlowFMDoes) {
  // Two right-angled triangles of a square have one circumcentre: their link has no length.
  const mesh::DistributedMesh square = mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const Verdict small = judged(square, Solver::delft3d, Measure::link_length, true, 0.1);
  EXPECT_EQ(small.broken, 1);
  EXPECT_NEAR(small.worst, 0, 1e-15);
  // Between equilateral triangles with side 1, centres are 1/sqrt(3) apart and the root of the area is 3^(1/4)/2.
  const FlowLink even = flow_link({Vec2{0, 0}, Vec2{1, 0}}, {0.5, std::sqrt(0.75)}, {0.5, -std::sqrt(0.75)});
  EXPECT_NEAR(even.cosine.value(), 0, 1e-15);
  EXPECT_NEAR(even.length, 2 * std::pow(3, -0.75), 1e-14);
  // A centre outside of an obtuse triangle moves onto its side, and the link is no longer upright.
  const FlowLink leaning = flow_link({Vec2{0, 0}, Vec2{1, 0}}, {1.6, 0.4}, {0.5, -std::sqrt(0.75)});
  EXPECT_GT(leaning.cosine.value(), 0.01);
  const mesh::DistributedMesh obtuse =
      mesh_of({{0, 0}, {1, 0}, {1.6, 0.4}, {0.5, -std::sqrt(0.75)}}, {{0, 1, 2}, {0, 3, 1}});
  const Verdict cosine = judged(obtuse, Solver::delft3d, Measure::link_cosine, false, 0.01);
  EXPECT_EQ(cosine.broken, 1);
  EXPECT_NEAR(cosine.worst, leaning.cosine.value(), 1e-12);
}

TEST(Judge, MeasuresNoAngleOfALinkWithoutADirection) {
  // The triangles of a rotated square have one circumcentre up to rounding, near the origin and far away from it.
  for (const double far : {0.0, 1e6})
    for (int k = 0; k < 200; ++k) {
      const double angle = 0.01 * k, c = std::cos(angle), s = std::sin(angle);
      const auto at = [&](double x, double y) { return Vec2{far + 10 * (c * x - s * y), far + 10 * (s * x + c * y)}; };
      EXPECT_FALSE(flow_link({at(0, 0), at(1, 1)}, at(0, 1), at(1, 0)).cosine.has_value()) << far << ' ' << angle;
      EXPECT_TRUE(flow_link({at(0, 0), at(1, 1)}, at(0, 1), at(1, -0.001)).cosine.has_value()) << far << ' ' << angle;
    }
  const mesh::DistributedMesh square = mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const Verdict cosine = judged(square, Solver::delft3d, Measure::link_cosine, false, 0.5);
  EXPECT_EQ(cosine.measured, 0);
  EXPECT_TRUE(cosine.holds());
}

TEST(Judge, FindsTrianglesWithoutAreaInfinitelyBad) {
  // Of three triangles, the first one is good, the second one is flat or lies upside down, the third one is a needle.
  const std::vector<Ids> triangles{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  for (const double height : {0.0, -0.5}) {
    const mesh::DistributedMesh mesh =
        mesh_of({{0, 0}, {1, 0}, {0.5, 0.8}, {2, 0}, {4, 0}, {3, height}, {5, 0}, {6, 0}, {5.5, 1e-4}}, triangles);
    const Verdict skew = judged(mesh, Solver::schism, Measure::skewness, false, 15);
    EXPECT_EQ(skew.broken, 2);
    EXPECT_TRUE(std::isinf(skew.worst));
    EXPECT_NEAR(skew.place.x, 3, 1e-12);
    EXPECT_GE(judged(mesh, Solver::adcirc, Measure::least_angle, true, 10).broken, 2);
  }
  const mesh::DistributedMesh pair = mesh_of({{0, 0}, {1, 0}, {0.5, 0.8}, {0.5, 0}}, {{0, 1, 2}, {0, 3, 1}});
  const Verdict share = judged(pair, Solver::fvcom, Measure::area_share, true, 0.5);
  EXPECT_EQ(share.broken, 1);
  EXPECT_EQ(share.worst, 0);
}

TEST(Judge, AllowsForRoundingAtALimit) {
  // Half a corner of 60 degrees has 30 degrees.
  for (int k = 0; k < 8; ++k) {
    const double turn = 0.4 * k, wide = turn + std::numbers::pi / 6;
    const mesh::DistributedMesh half =
        mesh_of({{0, 0}, {std::cos(turn), std::sin(turn)}, {std::cos(wide), std::sin(wide)}}, {{0, 1, 2}});
    EXPECT_EQ(judged(half, Solver::fvcom, Measure::least_angle, true, 30).broken, 0) << k;
  }
}

TEST(Judge, KnowsPartsAndLoopsOfTheWholeBoundary) {
  const Verdict parts = judged(wheel(6), Solver::adcirc, Measure::components, false, 1, {{}, 3, 3, 0, {}});
  EXPECT_EQ(parts.broken, 2);
  EXPECT_EQ(parts.worst, 3);
  EXPECT_FALSE(parts.has_place());
  const Verdict loop = judged(wheel(6), Solver::schism, Measure::looped_open_boundary, false, 0, {{}, 1, 1, 1, {}});
  EXPECT_EQ(loop.broken, 1);
}

TEST(Judge, MeasuresAcrossTheBorderOfAPeriodicContainer) {
  // Two equilateral triangles whose common side crosses the border at x = 0 of a container with the period 4.
  const geometry::Periods periods{4, 0, {0, 0}};
  const double height = std::sqrt(0.75);
  const mesh::DistributedMesh pair =
      mesh_of({{3.5, 1}, {0.5, 1}, {0, 1 + height}, {0, 1 - height}}, {{0, 1, 2}, {0, 3, 1}});
  const BoundaryFacts facts{periods, 1, 1, 0, {}};
  EXPECT_NEAR(judged(pair, Solver::fvcom, Measure::least_angle, true, 30, facts).worst, 60, 1e-9);
  EXPECT_NEAR(judged(pair, Solver::fvcom, Measure::area_share, true, 0.5, facts).worst, 1, 1e-12);
}

TEST(SolverRules, AreReadByTheirWords) {
  for (const Solver solver : all_solvers)
    EXPECT_EQ(solver_of_word(word_of(solver)), solver);
  EXPECT_FALSE(solver_of_word("swan").has_value());
  for (const SolverRule& rule : solver_rules())
    EXPECT_FALSE(name_of(rule.measure).empty());
}

} // namespace
} // namespace trime::acceptance
