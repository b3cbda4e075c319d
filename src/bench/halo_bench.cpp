// SPDX-License-Identifier: BSD-3-Clause
// Times the communication of a sweep: the ghosts of the halo, and the sites that change their owner. Argument: points
// on all ranks. For mpirun; every benchmark runs a fixed number of iterations, the same on each rank.
#include "bench/bench_points.hpp"
#include "decomposition/halo.hpp"
#include "decomposition/migration.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace trime::bench {
namespace {

constexpr int margin = 2, iterations = 20;

/// A jittered lattice distributed over the ranks, with its halo.
struct Stage {
  explicit Stage(const benchmark::State& state)
      : comm(comm::Communicator::world()), grid(unit_square, {{}, {}, spacing_of(state.range(0))}),
        partition(grid.tile_count(), comm.size()), points(grid), halo(comm, grid) {
    for (const mesh::Site& site : jittered_lattice(state.range(0), 0.15))
      if (partition.owner(grid.place(site.position).tile) == comm.rank())
        sites.push_back(site);
    partition = decomposition::Partition(decomposition::tile_weights(comm, grid, sites), comm.size());
    decomposition::migrate(comm, grid, partition, sites);
    points.assign_owned(sites, partition.first_tile(comm.rank()), partition.last_tile(comm.rank()));
    halo.reset(partition, margin);
    halo.refresh(points);
  }
  std::int64_t ghosts() const { return comm.sum(std::int64_t{points.size() - points.owned()}); }

  comm::Communicator comm;
  mesh::TileGrid grid;
  decomposition::Partition partition;
  mesh::BinnedPoints points;
  decomposition::Halo halo;
  mesh::SiteList sites;
};

void halo_refresh(benchmark::State& state) {
  Stage stage(state);
  stage.comm.barrier();
  for (auto _ : state)
    stage.halo.refresh(stage.points);
  state.counters["ranks"] = stage.comm.size();
  state.counters["ghosts"] = static_cast<double>(stage.ghosts());
}

void halo_values(benchmark::State& state) {
  Stage stage(state);
  const std::vector<GlobalId> values(static_cast<std::size_t>(stage.points.owned()), 1);
  stage.comm.barrier();
  for (auto _ : state)
    benchmark::DoNotOptimize(stage.halo.exchange(stage.points, values).size());
  state.counters["ranks"] = stage.comm.size();
  state.counters["ghosts"] = static_cast<double>(stage.ghosts());
}

/// Every site moves by 0.02 spacings, back and forth; some cross the border between two ranks.
void migration(benchmark::State& state) {
  Stage stage(state);
  double step = 0.02 * spacing_of(state.range(0));
  std::int64_t travelled = 0;
  stage.comm.barrier();
  for (auto _ : state) {
    for (mesh::Site& site : stage.sites)
      site.position = site.position + geometry::Vec2{step, step};
    step = -step;
    travelled += std::count_if(stage.sites.begin(), stage.sites.end(), [&](const mesh::Site& site) {
      return stage.partition.owner(stage.grid.tile_at(site.position)) != stage.comm.rank();
    });
    decomposition::migrate(stage.comm, stage.grid, stage.partition, stage.sites);
  }
  state.counters["ranks"] = stage.comm.size();
  state.counters["travelled"] = static_cast<double>(stage.comm.sum(travelled)) / iterations;
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("points")->Arg(100000)->Arg(1000000)->Iterations(iterations);
  benchmark->Unit(benchmark::kMicrosecond)->UseRealTime();
}

BENCHMARK(halo_refresh)->Apply(sizes);
BENCHMARK(halo_values)->Apply(sizes);
BENCHMARK(migration)->Apply(sizes);

} // namespace
} // namespace trime::bench
