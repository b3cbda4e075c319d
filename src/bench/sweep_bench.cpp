// SPDX-License-Identifier: BSD-3-Clause
// Times the passes of a sweep over a relaxed mesh where nothing changes: certified update and move, and the quality,
// for each kind of processor. Arguments: number of points; rule (0 bars, 1 cells, 2 triangles).
#include "bench/bench_points.hpp"
#include "core/simd_level.hpp"
#include "decomposition/migration.hpp"
#include "delaunay/star_builder.hpp"
#include "sweep/sweep_kernel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace trime::bench {
namespace {

using sweep::SiteClass;
using sweep::SweepKernels;
using sweep::SweepTask;

/// A jittered lattice with its stars.
struct Stage {
  explicit Stage(const benchmark::State& state)
      : n(state.range(0)), grid(unit_square, {{}, {}, spacing_of(n)}), points(grid), lattice(unit_square),
        sizes(spacing_of(n)) {
    const mesh::SiteList sites = jittered_lattice(n, 0.15);
    decomposition::fit_tiles(comm::Communicator::self(), grid, sites);
    grid.set_bin_bits(points.suitable_bin_bits(sites, 0, grid.tile_count()));
    points.assign_owned(sites, 0, grid.tile_count());
    stars.reset(points.owned());
    std::vector<mesh::BinRef> missing;
    delaunay::StarBuilder(lattice, 2.5, 1).update(points, stars, sizes, {}, missing);
    points.prepare_advance();
    for (LocalIndex i = 0; i < points.owned(); ++i) {
      const auto ring = stars.ring(i);
      classes.push_back(ring.size() < 3 || ring.size() > 8 || std::ranges::find(ring, delaunay::gap) != ring.end()
                            ? SiteClass::held
                            : SiteClass::local);
    }
    task.positions = points.positions().data();
    task.leads = points.leads().data();
    task.rings = stars.all_slots();
    task.degrees = stars.degrees();
    task.classes = classes.data();
    task.uniform_size = sizes[0];
    task.next_positions = points.next().positions().data();
    task.next_leads = points.next().leads().data();
    task.rule.mover = static_cast<sweep::Mover>(state.range(1));
    task.rule.length_scale = sweep::SweepRules::bar_pressure;
    task.rule.momentum = 0.5;
    task.lattice_step = lattice.step();
    task.inverse_lattice_step = lattice.inverse_step();
    task.box = unit_square;
    task.cap_factor = 2.5;
  }

  std::int64_t n;
  mesh::TileGrid grid;
  mesh::BinnedPoints points;
  geometry::Lattice lattice;
  mesh::LocalSizes sizes;
  delaunay::StarTable stars;
  std::vector<SiteClass> classes;
  SweepTask task;
};

void per_point(benchmark::State& state, double points) {
  state.counters["ns_per_point"] =
      benchmark::Counter(points * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void certify_and_move(benchmark::State& state, const SweepKernels& kernels) {
  Stage stage(state);
  std::vector<LocalIndex> suspects(static_cast<std::size_t>(stage.points.owned())), irregular(suspects.size()),
      guarded(suspects.size());
  std::vector<std::uint8_t> flags(suspects.size());
  stage.task.flags = flags.data();
  for (auto _ : state)
    for (LocalIndex tile = 0; tile < stage.grid.tile_count(); ++tile) {
      const auto [begin, end] = stage.points.tile_range(tile);
      sweep::SweepLeftovers leftovers{suspects.data(), irregular.data(), guarded.data()};
      std::fill(flags.begin() + begin, flags.begin() + end, sweep::SiteFlags::awake);
      benchmark::DoNotOptimize(kernels.sweep(stage.task, begin, end, leftovers));
    }
  per_point(state, static_cast<double>(stage.points.owned()));
}

void measure(benchmark::State& state, const SweepKernels& kernels) {
  Stage stage(state);
  std::vector<double> excesses(delaunay::StarTable::slots * sweep::most_measured);
  for (auto _ : state)
    for (LocalIndex begin = 0; begin < stage.points.owned(); begin += sweep::most_measured)
      benchmark::DoNotOptimize(kernels.measure(stage.task, begin,
                                               std::min(stage.points.owned(), begin + sweep::most_measured),
                                               1 / stage.sizes[0], excesses.data()));
  per_point(state, static_cast<double>(stage.points.owned()));
}

[[maybe_unused]] const bool registered = [] {
  struct Level {
    const char* name;
    SimdLevel level;
    const SweepKernels* kernels;
  };
  const std::vector<Level> levels{{"portable", SimdLevel::portable, &sweep::kernels_portable},
                                  {"avx2", SimdLevel::avx2, &sweep::kernels_avx2},
                                  {"avx512", SimdLevel::avx512, &sweep::kernels_avx512}};
  for (const Level& level : levels) {
    if (level.level > simd_level())
      continue;
    const SweepKernels& kernels = *level.kernels;
    auto* sweep = benchmark::RegisterBenchmark((std::string("certify_and_move/") + level.name).c_str(),
                                               [&kernels](benchmark::State& s) { certify_and_move(s, kernels); });
    sweep->ArgNames({"points", "rule"})->Unit(benchmark::kMillisecond)->UseRealTime();
    for (const std::int64_t n : {100000, 1000000})
      for (const std::int64_t rule : {0, 1, 2})
        sweep->Args({n, rule});
    benchmark::RegisterBenchmark((std::string("measure_quality/") + level.name).c_str(),
                                 [&kernels](benchmark::State& s) { measure(s, kernels); })
        ->ArgNames({"points", "rule"})
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Args({1000000, 1});
  }
  return true;
}();

} // namespace
} // namespace trime::bench
