// SPDX-License-Identifier: BSD-3-Clause
// Queries against a contour of 1e5 segments: nearest segment, inside test, and what every inner site asks in every
// sweep. Argument: distance of the query points from the curve in segment lengths; 0: anywhere in the unit square.
#include "bench/bench_points.hpp"
#include "core/angle.hpp"
#include "polygon/boundary_guard.hpp"
#include "trime/geometry/segment_grid.hpp"

#include <benchmark/benchmark.h>

namespace trime::bench {
namespace {

using geometry::Vec2;

constexpr int segments = 100000, queries = 1 << 16;

/// A wavy closed curve around the middle: radius 0.35 with 60 waves of 2 %.
Vec2 curve_point(double turn, double offset) {
  const SinCos direction = sin_cos(2 * pi * turn), wave = sin_cos(120 * pi * turn);
  const double radius = 0.35 * (1 + 0.02 * wave.sin) + offset;
  return Vec2{0.5, 0.5} + radius * Vec2{direction.cos, direction.sin};
}

struct Stage {
  Stage() : lattice(unit_square) {
    std::vector<geometry::Segment> list;
    for (LocalIndex k = 0; k < segments; ++k) {
      const LocalIndex next = k + 1 == segments ? 0 : k + 1;
      const Vec2 a = lattice.snap(curve_point(static_cast<double>(k) / segments, 0));
      const Vec2 b = lattice.snap(curve_point(static_cast<double>(next) / segments, 0));
      list.push_back({a, b});
      sites.sites.push_back({a, k == 0 ? segments - 1 : k - 1, next, 1, false});
    }
    sites.loop_start = {0, segments};
    grid = geometry::SegmentGrid(list);
  }
  double spacing() const { return 2 * pi * 0.35 / segments; }
  std::vector<Vec2> points(std::int64_t distance) const {
    std::vector<Vec2> list;
    for (std::uint64_t key = 0; key < queries; ++key) {
      const double u = 0.5 + 0.5 * noise(key, 0), v = noise(key, 1);
      list.push_back(lattice.snap(distance == 0 ? Vec2{u, 0.5 + 0.5 * v}
                                                : curve_point(u, static_cast<double>(distance) * spacing() * v)));
    }
    return list;
  }

  geometry::Lattice lattice;
  polygon::BoundarySites sites;
  geometry::SegmentGrid grid;
};

const Stage& stage() {
  static const Stage the_stage;
  return the_stage;
}

/// Runs ask(point) over all query points.
template <class Ask>
void run(benchmark::State& state, const Ask& ask) {
  const std::vector<Vec2> points = stage().points(state.range(0));
  for (auto _ : state)
    for (const Vec2 p : points)
      benchmark::DoNotOptimize(ask(p));
  state.counters["ns_per_query"] =
      benchmark::Counter(queries * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void nearest_segment(benchmark::State& state) {
  run(state, [](Vec2 p) { return stage().grid.nearest(p); });
}
void inside_contour(benchmark::State& state) {
  run(state, [](Vec2 p) { return stage().grid.inside(p); });
}
void guard_correct(benchmark::State& state) {
  const polygon::BoundaryGuard guard(stage().sites, stage().lattice);
  const double h = stage().spacing();
  run(state, [&](Vec2 p) { return guard.correct(p, h, stage().lattice); });
}
void guard_build(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(polygon::BoundaryGuard(stage().sites, stage().lattice).memory_bytes());
}

BENCHMARK(nearest_segment)->ArgName("distance")->Arg(0)->Arg(1)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(inside_contour)->ArgName("distance")->Arg(0)->Arg(1)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(guard_correct)->ArgName("distance")->Arg(0)->Arg(1)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(guard_build)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace trime::bench
