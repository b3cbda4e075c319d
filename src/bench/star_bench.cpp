// SPDX-License-Identifier: BSD-3-Clause
// Stars against CGAL's Delaunay triangulation of the same points in the same run. Arguments: number of points; 0 like a
// relaxed mesh, 1 random, 2 random with density ratio 900.
#include "bench/bench_points.hpp"
#include "decomposition/migration.hpp"
#include "delaunay/star_builder.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

namespace trime::bench {
namespace {

enum PointSet : std::int64_t { relaxed, random_set, graded_set };

/// Points in tiles and a builder for them.
struct Stage {
  explicit Stage(const benchmark::State& state)
      : n(state.range(0)), grid(unit_square, {{}, {}, spacing_of(n)}), points(grid), lattice(unit_square),
        builder(lattice, 2.5, 1.0) {
    sites = state.range(1) == relaxed      ? jittered_lattice(n, 0.15)
            : state.range(1) == random_set ? random_points(n)
                                           : graded_points(n);
    decomposition::fit_tiles(comm::Communicator::self(), grid, sites);
    grid.set_bin_bits(points.suitable_bin_bits(sites, 0, grid.tile_count()));
    points.assign_owned(sites, 0, grid.tile_count());
    factor = state.range(1) == graded_set ? graded_factor(n) : 0;
    find_sizes();
    sites.clear();
    for (LocalIndex i = 0; i < points.owned(); ++i)
      sites.push_back(points.site(i)); // in tile order
  }

  double size(geometry::Vec2 p) const { return factor > 0 ? factor * graded_size(p) : spacing_of(n); }
  void find_sizes() {
    if (factor == 0) {
      sizes = mesh::LocalSizes(spacing_of(n));
      return;
    }
    sizes.forget();
    for (const geometry::Vec2 p : points.positions())
      sizes.values().push_back(size(p));
  }

  /// Every site moves by `step` spacings in a different direction; the order of the sites stays.
  void shake(double step, std::uint64_t round) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const geometry::Vec2 p = sites[i].position;
      const geometry::Vec2 d{noise(i, 4 + 2 * round), noise(i, 5 + 2 * round)};
      const double length = std::max(1e-3, geometry::length(d));
      const geometry::Vec2 q = lattice.snap(p + (step * size(p) / length) * d);
      if (unit_square.contains(q))
        sites[i].position = q;
    }
  }

  std::int64_t n;
  mesh::TileGrid grid;
  mesh::BinnedPoints points;
  geometry::Lattice lattice;
  delaunay::StarBuilder builder;
  mesh::SiteList sites;
  double factor = 0; // of the graded size; 0: uniform
  mesh::LocalSizes sizes;
};

void per_point(benchmark::State& state, double points) {
  state.counters["ns_per_point"] =
      benchmark::Counter(points * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void stars_from_scratch(benchmark::State& state) {
  Stage stage(state);
  delaunay::StarTable stars;
  std::vector<mesh::BinRef> missing;
  for (auto _ : state) {
    stars.reset(stage.points.owned());
    stage.builder.update(stage.points, stars, stage.sizes, {}, missing);
  }
  per_point(state, static_cast<double>(stage.points.owned()));
}

/// Star update after moves of 0.02 h; moving, sorting and renumbering are not timed here (see sort_and_renumber).
void star_update(benchmark::State& state) {
  Stage stage(state);
  delaunay::StarTable stars;
  std::vector<mesh::BinRef> missing;
  std::vector<LocalIndex> new_index;
  stars.reset(stage.points.owned());
  stage.builder.update(stage.points, stars, stage.sizes, {}, missing);
  std::uint64_t round = 0;
  std::int64_t rebuilt = 0;
  for (auto _ : state) {
    state.PauseTiming();
    stage.shake(0.02, round++);
    stage.points.assign_owned(stage.sites, 0, stage.grid.tile_count(), &new_index);
    stars.renumber(new_index, stage.points.owned());
    stage.find_sizes();
    stage.sites.clear();
    for (LocalIndex i = 0; i < stage.points.owned(); ++i)
      stage.sites.push_back(stage.points.site(i));
    state.ResumeTiming();
    rebuilt += stage.builder.update(stage.points, stars, stage.sizes, {}, missing).rebuilt;
  }
  per_point(state, static_cast<double>(stage.points.owned()));
  state.counters["rebuilt_percent"] = 100.0 * static_cast<double>(rebuilt) / static_cast<double>(state.iterations()) /
                                      static_cast<double>(stage.points.owned());
}

void sort_and_renumber(benchmark::State& state) {
  Stage stage(state);
  delaunay::StarTable stars;
  std::vector<mesh::BinRef> missing;
  std::vector<LocalIndex> new_index;
  stars.reset(stage.points.owned());
  stage.builder.update(stage.points, stars, stage.sizes, {}, missing);
  stage.shake(0.02, 0);
  for (auto _ : state) {
    stage.points.assign_owned(stage.sites, 0, stage.grid.tile_count(), &new_index);
    stars.renumber(new_index, stage.points.owned());
  }
  per_point(state, static_cast<double>(stage.points.owned()));
}

void cgal_delaunay(benchmark::State& state) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Stage stage(state);
  std::vector<Kernel::Point_2> points;
  for (const mesh::Site& site : stage.sites)
    points.emplace_back(site.position.x, site.position.y);
  for (auto _ : state) {
    CGAL::Delaunay_triangulation_2<Kernel> triangulation(points.begin(), points.end());
    benchmark::DoNotOptimize(triangulation.number_of_faces());
  }
  per_point(state, static_cast<double>(points.size()));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"points", "set"})->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const std::int64_t n : {100000, 1000000})
    for (const std::int64_t set : {relaxed, random_set, graded_set})
      benchmark->Args({n, set});
}

BENCHMARK(cgal_delaunay)->Apply(sizes);
BENCHMARK(stars_from_scratch)->Apply(sizes);
BENCHMARK(star_update)->Apply(sizes);
BENCHMARK(sort_and_renumber)->Apply(sizes);

} // namespace
} // namespace trime::bench
