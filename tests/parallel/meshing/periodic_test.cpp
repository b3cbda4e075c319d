// SPDX-License-Identifier: BSD-3-Clause
// The whole mesher in periodic containers: certified, the same bits on any ranks, and lattices that stay.
#include "boundary/fixed_points.hpp"
#include "core/random.hpp"
#include "fitting/layout.hpp"
#include "meshing/plan.hpp"
#include "support/distributed.hpp"
#include "support/periodic_shapes.hpp"
#include "support/plain_shapes.hpp"
#include "sweep/guard_treatment.hpp"
#include "sweep/sweep_record.hpp"
#include "trime/meshing/mesher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using boundary::FixedPoints;
using fitting::FitOptions;
using fitting::FittedSize;
using fitting::lay_stage;
using fitting::LayoutContext;
using fitting::place_sites;
using geometry::Frame;
using geometry::Vec2;
using shape::RegionShape;
using sites::SiteState;
using sites::Stage;
using sites::Wanted;
using sweep::CvdRule;
using sweep::DistMeshRule;
using sweep::Method;
using sweep::summarize_sweep;
using sweep::Sweeper;
using sweep::SweepRecord;
using sweep::UpdateRule;

MeshOptions options_for(GlobalId points, Method method) {
  MeshOptions options;
  options.points = points;
  options.method = method;
  options.max_sweeps = 10;
  return options;
}

MeshResult run(const comm::Communicator& comm, const RegionShape& shape, const MeshOptions& options,
               const sizing::SizeField& size) {
  return testing::mesh_silently(comm, shape.domain(), size, options);
}

double check_of(const MeshResult& result, const std::string& name) {
  for (const mesh::Check& check : result.checks)
    if (check.name == name)
      return check.found;
  return NAN;
}

void expect_certified(const RegionShape& shape, const MeshResult& result) {
  testing::expect_certified(result);
  EXPECT_EQ(check_of(result, "euler_characteristic"), shape.boundary().euler_characteristic());
  const double torus = shape.frame().periods().x * shape.frame().periods().y;
  if (shape.boundary().loops.empty()) {
    EXPECT_EQ(check_of(result, "area"), torus);
  } else {
    EXPECT_NEAR(check_of(result, "area"), shape.boundary().area, 0.02 * shape.boundary().area);
  }
}

/// One rank alone and all together: certified, and the same mesh.
void expect_same_everywhere(const RegionShape& shape, const MeshOptions& options,
                            const sizing::SizeField& size = sizing::UniformSize()) {
  SCOPED_TRACE(shape.region().text());
  const comm::Communicator world = comm::Communicator::world();
  MeshResult serial;
  if (world.is_root()) {
    const testing::OnThreads one(1);
    serial = run(comm::Communicator::self(), shape, options, size);
    expect_certified(shape, serial);
  }
  const testing::OnThreads two(2);
  const MeshResult result = run(world, shape, options, size);
  expect_certified(shape, result);
  const std::vector<Vec2> points = testing::gather_all(world, result.mesh.points);
  const auto triangles = testing::gather_all(world, global_triangles(result.mesh));
  EXPECT_LE(result.mesh.point_slab.total, *options.points);
  EXPECT_GE(10 * result.mesh.point_slab.total, 9 * *options.points);
  for (const Vec2 p : result.mesh.points)
    ASSERT_EQ(shape.frame().periods().wrap(p), p);
  if (world.is_root()) {
    EXPECT_EQ(result.mesh.hash, serial.mesh.hash);
    EXPECT_TRUE(std::ranges::equal(points, serial.mesh.points));
    EXPECT_TRUE(triangles == global_triangles(serial.mesh));
    EXPECT_EQ(result.quality.alpha.max, serial.quality.alpha.max);
  }
}

TEST(PeriodicMesher, AllShapesAreCertifiedAndTheSameOnAnyRanks) {
  for (const RegionShape& shape : testing::periodic_shapes())
    expect_same_everywhere(shape, options_for(900, Method::distmesh));
}

TEST(PeriodicMesher, ThreeEdgesMakeAPeriod) {
  for (const Method method : {Method::distmesh, Method::cvd, Method::hybrid})
    expect_same_everywhere(testing::whole_torus(), options_for(12, method));
}

TEST(PeriodicMesher, AllMethodsMeshATorusWithAHole) {
  for (const Method method : {Method::cvd, Method::hybrid})
    expect_same_everywhere(testing::torus_with_hole(), options_for(700, method));
}

/// Periodic along both axes.
class WavySize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override {
    const double x = p.x - std::floor(p.x), y = p.y - std::floor(p.y);
    return 0.5 + 2 * x * (1 - x) + y * (1 - y);
  }
};

TEST(PeriodicMesher, GradedSizesFromCoarseToFineAndByInsertion) {
  for (const RegionShape& shape : {testing::whole_torus(), testing::torus_with_hole()}) {
    MeshOptions options = options_for(1000, Method::hybrid);
    expect_same_everywhere(shape, options, WavySize());
    options.initial_fraction = 0.3;
    expect_same_everywhere(shape, options, WavySize());
  }
}

/// Largest distance from the points of a to the nearest ones of b, on the torus; both have as many.
double largest_gap(const std::vector<Vec2>& a, const std::vector<Vec2>& b, const geometry::Periods& periods) {
  double largest = 0;
  for (const Vec2 p : a) {
    double nearest = INFINITY;
    for (const Vec2 q : b)
      nearest = std::min(nearest, geometry::length(periods.nearest_image(q, p) - p));
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(PeriodicMesher, AHexagonalTorusThatFitsIsAFixedPointOfAllMethods) {
  const comm::Communicator world = comm::Communicator::world();
  const int columns = 24, rows = 20;
  const Frame frame(testing::hexagonal_container(columns, rows), true, true);
  const RegionShape shape({}, "domain", frame);
  std::vector<std::vector<Vec2>> results;
  for (const Method method : {Method::distmesh, Method::cvd, Method::hybrid}) {
    const MeshResult result = run(world, shape, options_for(columns * rows, method), sizing::UniformSize());
    expect_certified(shape, result);
    EXPECT_EQ(result.mesh.point_slab.total, columns * rows);
    EXPECT_EQ(result.mesh.triangle_slab.total, 2 * columns * rows);
    EXPECT_NEAR(result.quality.alpha.max, 1, 1e-9);
    for (const SweepRecord& record : result.history)
      EXPECT_LT(record.max_move, 1e-9);
    results.push_back(testing::gather_all(world, result.mesh.points));
  }
  for (const auto& points : results)
    EXPECT_LT(largest_gap(points, results[0], frame.periods()), 1e-9);
}

/// The lattice of hexagonal_container, each site moved by up to `share` of the spacing along each axis; on the root.
mesh::SiteList perturbed_lattice(const comm::Communicator& world, const Frame& frame, int columns, int rows,
                                 double share) {
  mesh::SiteList sites;
  const double spacing = 1.0 / columns;
  for (int k = 0; world.is_root() && k < columns * rows; ++k) {
    const int row = k / columns, column = k % columns;
    const Vec2 noise{random_unit(1, RandomPurpose::test, static_cast<std::uint64_t>(k), 0) - 0.5,
                     random_unit(1, RandomPurpose::test, static_cast<std::uint64_t>(k), 1) - 0.5};
    const Vec2 p{(column + 0.5 * (row % 2)) * spacing, row * std::sqrt(0.75) * spacing};
    sites.push_back({frame.lattice().snap(p + 2 * share * spacing * noise)});
  }
  return sites;
}

/// Longest distance of a site to its six nearest over the shortest, less 1: 0 for the lattice, wherever it lies.
double irregularity(const std::vector<Vec2>& points, const geometry::Periods& periods) {
  double shortest = INFINITY, longest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i)
        distances.push_back(geometry::length(periods.nearest_image(points[j], points[i]) - points[i]));
    std::nth_element(distances.begin(), distances.begin() + 5, distances.end());
    shortest = std::min(shortest, *std::min_element(distances.begin(), distances.begin() + 6));
    longest = std::max(longest, distances[5]);
  }
  return longest / shortest - 1;
}

std::vector<Vec2> inner_positions(const SiteState& state) {
  std::vector<Vec2> positions;
  for (LocalIndex i = 0; i < state.points().owned(); ++i)
    positions.push_back(state.points().position(i));
  return positions;
}

TEST(PeriodicMesher, APerturbedHexagonalTorusReturns) {
  const comm::Communicator world = comm::Communicator::world();
  const int columns = 12, rows = 10;
  const Frame frame(testing::hexagonal_container(columns, rows), true, true);
  const RegionShape shape({}, "domain", frame);
  const sizing::UniformSize size;
  const MeshOptions options = options_for(columns * rows, Method::hybrid);
  const FitOptions fit = fit_options(options, size);
  Log log(LogLevel::silent, false);
  TimerTable timers;
  const FixedPoints none(shape.boundary(), frame.container(), {}, frame.lattice(), log);
  const LayoutContext context{world, shape.domain(), size, fit, log, timers, none};
  // Bars all the way, cells all the way, and cells after bars as the hybrid method has it.
  for (const auto& [by_bars, sweeps] : {std::pair{360, 360}, {0, 120}, {40, 160}}) {
    FittedSize fitted{1.0 / columns};
    Stage layout = lay_stage(context, fitted, 1, columns * rows);
    place_sites(context, layout, perturbed_lattice(world, frame, columns, rows, 0.15));
    const delaunay::StarBuilder builder(frame.lattice(), 1);
    DistMeshRule bars;
    CvdRule cells;
    EXPECT_GT(irregularity(testing::gather_all(world, inner_positions(*layout.state)), frame.periods()), 0.3);
    layout.state->compute_stars(builder, *layout.size, Wanted::inner_sites);
    Sweeper sweeper(*layout.state, builder, {*layout.guard, *layout.size, frame.lattice()});
    Sweeper::Counts moved;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      UpdateRule& rule = sweep < by_bars ? static_cast<UpdateRule&>(bars) : cells;
      rule.begin_sweep(summarize_sweep(*layout.state, sweeper, moved, layout.typical_size, layout.placed_first()).sums);
      sweeper.prepare(rule);
      moved = sweeper.commit();
    }
    EXPECT_LT(irregularity(testing::gather_all(world, inner_positions(*layout.state)), frame.periods()), 1e-3)
        << by_bars;
  }
}

} // namespace
} // namespace trime::meshing
