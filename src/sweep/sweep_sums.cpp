// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/sweep_sums.hpp"

#include "core/thread_loop.hpp"
#include "sweep/rule_formulas.hpp"
#include "sweep/rules.hpp"

#include <algorithm>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using sites::StarView;

/// A triangle with several inner sites is measured from the lexicographically smallest of them.
bool is_measured_from(const mesh::BinnedPoints& points, Vec2 p, LocalIndex a, LocalIndex b) {
  const geometry::Periods& periods = points.grid().periods();
  return (points.boundary(a) >= 0 || periods.less(p, points.position(a))) &&
         (points.boundary(b) >= 0 || periods.less(p, points.position(b)));
}

} // namespace

void SweepSums::add(const SweepSums& other) {
  squared_length_ratio.add(other.squared_length_ratio);
  squared_size_ratio.add(other.squared_size_ratio);
  excess_alpha.add(other.excess_alpha);
  alpha_bins.add(other.alpha_bins);
  triangles += other.triangles;
  max_alpha = std::max(max_alpha, other.max_alpha);
  power.add(other.power);
}

void measure_star(const StarView& view, LocalIndex i, double reference_size, SweepSums& sums) {
  const std::span<const LocalIndex> ring = view.stars.ring(i);
  const Vec2 p = view.points.position(i);
  const double own_size = view.size(i), inverse = 1 / reference_size;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LocalIndex i_a = ring[k], i_b = ring[k + 1 == ring.size() ? 0 : k + 1];
    if (i_a == delaunay::gap)
      continue;
    const Spoke<double> a = spoke_to(view, p, i_a);
    const double h = view.is_uniform() ? own_size * inverse : 0.5 * (own_size + a.size) * inverse;
    sums.squared_length_ratio.add(std::min(SweepRules::largest_term, a.squared * (inverse * inverse)));
    sums.squared_size_ratio.add(std::min(SweepRules::largest_term, h * h));
    if (i_b == delaunay::gap || !is_measured_from(view.points, p, i_a, i_b))
      continue;
    const Spoke<double> b = spoke_to(view, p, i_b);
    const double excess = excess_of_alpha(a, b, a.x * b.y - a.y * b.x);
    sums.excess_alpha.add(std::min(excess, SweepRules::largest_excess_term));
    sums.alpha_bins.add(excess);
    sums.max_alpha = std::max(sums.max_alpha, 1 + excess);
    ++sums.triangles;
  }
}

SweepSums measure(const StarView& view, double reference_size) {
  PerThread<SweepSums> of_thread;
  const LocalIndex first_tile = view.points.first_tile();
  thread_loop(view.points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int thread) {
    const auto [begin, end] = view.points.tile_range(first_tile + static_cast<LocalIndex>(t));
    SweepSums& sums = of_thread[thread];
    for (LocalIndex i = begin; i < end; ++i)
      if (view.points.boundary(i) < 0)
        measure_star(view, i, reference_size, sums);
  });
  SweepSums all;
  for (const SweepSums& sums : of_thread)
    all.add(sums);
  return all;
}

} // namespace trime::sweep
