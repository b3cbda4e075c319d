// SPDX-License-Identifier: BSD-3-Clause
// The automatic size field of a rough closed coast with 5000 segments: set-up for a mesh of this number of points, and
// the time of each look-up, for random points and for points row by row.
#include "bench/bench_points.hpp"
#include "core/angle.hpp"
#include "trime/sizing/automatic_size.hpp"

#include <benchmark/benchmark.h>

namespace trime::bench {
namespace {

using geometry::Vec2;

constexpr int segments = 5000, queries = 1 << 16;
constexpr double gradation = 0.2, area = 0.35;

/// Radius 0.35 with bays of all sizes, each two thirds as deep as the next larger.
geometry::Boundary rough_coast() {
  std::vector<Vec2> points;
  for (int k = 0; k < segments; ++k) {
    double radius = 0.35;
    double depth = 0.05;
    for (int octave = 0; octave < 10; ++octave, depth *= 2.0 / 3) {
      const double place = static_cast<double>(k) * (8 << octave) / segments;
      const auto knot = static_cast<std::uint64_t>(place);
      const std::uint64_t wave = static_cast<std::uint64_t>(octave) + 10, knots = 8u << octave;
      const double part = place - static_cast<double>(knot);
      radius += depth * ((1 - part) * noise(knot, wave) + part * noise((knot + 1) % knots, wave));
    }
    const SinCos direction = sin_cos(2 * pi * k / segments);
    points.push_back(Vec2{0.5, 0.5} + radius * Vec2{direction.cos, direction.sin});
  }
  geometry::Boundary boundary;
  boundary.loops.emplace_back();
  for (int k = 0; k < segments; ++k) {
    geometry::Piece piece;
    piece.start = points[k];
    piece.end = points[(k + 1) % segments];
    boundary.loops[0].pieces.push_back(piece);
  }
  return boundary;
}

/// For a mesh of n points.
sizing::AutomaticSizeOptions options(std::int64_t n) {
  return {gradation, 0.5 * spacing_of(n) * std::sqrt(area), unit_square, 0, 0};
}

void size_field_build(benchmark::State& state) {
  const comm::Communicator comm = comm::Communicator::self();
  const geometry::Boundary coast = rough_coast();
  for (auto _ : state) {
    const sizing::AutomaticSize field(comm, coast, options(state.range(0)));
    state.counters["MB"] = static_cast<double>(field.memory_bytes()) * 1e-6;
  }
}

void size_field_look_up(benchmark::State& state) {
  const sizing::AutomaticSize field(comm::Communicator::self(), rough_coast(), options(state.range(0)));
  std::vector<Vec2> points;
  for (std::uint64_t key = 0; key < queries; ++key)
    points.push_back(state.range(1) != 0
                         ? Vec2{0.5 + 0.5 * noise(key, 0), 0.5 + 0.5 * noise(key, 1)}
                         : Vec2{static_cast<double>(key % 256) / 256, static_cast<double>(key / 256) / 256});
  for (auto _ : state)
    for (const Vec2 p : points)
      benchmark::DoNotOptimize(field.size(p));
  state.counters["ns_per_query"] =
      benchmark::Counter(queries * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(size_field_build)->ArgName("n")->Arg(20000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(size_field_look_up)
    ->ArgNames({"n", "random"})
    ->Args({1000000, 0})
    ->Args({1000000, 1})
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace trime::bench
