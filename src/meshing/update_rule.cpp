// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/update_rule.hpp"

#include "meshing/rule_formulas.hpp"
#include "meshing/sweep_kernel.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

/// A triangle with several inner sites is measured from the lexicographically smallest of them.
bool is_measured_from(const mesh::BinnedPoints& points, Vec2 p, LocalIndex a, LocalIndex b) {
  const geometry::Periods& periods = points.grid().periods();
  return (points.boundary(a) >= 0 || periods.less(p, points.position(a))) &&
         (points.boundary(b) >= 0 || periods.less(p, points.position(b)));
}

Spoke<double> spoke_to(const StarView& view, Vec2 p, LocalIndex neighbour) {
  const Vec2 u = view.points.position(neighbour) - p;
  return {u.x, u.y, u.x * u.x + u.y * u.y, view.size(neighbour)};
}

/// Adds the triangles of site i to a formula; no move if there is a gap among them.
template <class Formula>
Vec2 move_by_triangles(const StarView& view, LocalIndex i, Formula formula) {
  const std::span<const LocalIndex> ring = view.stars.ring(i);
  if (ring.size() < 3 || std::find(ring.begin(), ring.end(), delaunay::gap) != ring.end())
    return {};
  const Vec2 p = view.points.position(i);
  Spoke<double> a = spoke_to(view, p, ring[0]);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Spoke<double> b = spoke_to(view, p, ring[k + 1 == ring.size() ? 0 : k + 1]);
    formula.add(a, b, a.x * b.y - a.y * b.x, true);
    a = b;
  }
  const Move<double> move = formula.move();
  return {move.x, move.y};
}

/// Adds the bars of site i to a formula.
template <class Formula>
Vec2 force(const StarView& view, LocalIndex i, Formula formula) {
  const Vec2 p = view.points.position(i);
  for (const LocalIndex neighbour : view.stars.ring(i))
    if (neighbour != delaunay::gap) {
      const Spoke<double> bar = spoke_to(view, p, neighbour);
      formula.add(bar, bar, 0, true);
    }
  return {formula.move().x, formula.move().y};
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
    sums.squared_length_ratio.add(std::min(largest_term, a.squared * (inverse * inverse)));
    sums.squared_size_ratio.add(std::min(largest_term, h * h));
    if (i_b == delaunay::gap || !is_measured_from(view.points, p, i_a, i_b))
      continue;
    const Spoke<double> b = spoke_to(view, p, i_b);
    const double excess = excess_of_alpha(a, b, a.x * b.y - a.y * b.x);
    sums.excess_alpha.add(std::min(excess, largest_excess_term));
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

void Momentum::begin_sweep(const SweepSums& sums) {
  if (sums.power.value() > 0)
    age_ = 0;
  factor_ = std::min(largest, static_cast<double>(age_) / (age_ + 3));
  ++age_;
}

Step Momentum::step(const StarView& view, LocalIndex i, Vec2 move) const {
  return {move, factor_ * (move + view.points.leads()[static_cast<std::size_t>(i)])};
}

void DistMeshRule::begin_sweep(const SweepSums& sums) {
  const double sizes = sums.squared_size_ratio.value();
  length_scale_ = sizes > 0 ? pressure * std::sqrt(sums.squared_length_ratio.value() / sizes) : pressure;
}

Step DistMeshRule::step(const StarView& view, LocalIndex i) const {
  const double h = view.size(i);
  return {view.is_uniform() ? force(view, i, BarFormula<double, false>(parameters(), h))
                            : force(view, i, BarFormula<double, true>(parameters(), h)),
          {}};
}

RuleParameters DistMeshRule::parameters() const {
  RuleParameters rule;
  rule.kind = RuleParameters::Kind::bars;
  rule.length_scale = length_scale_;
  return rule;
}

Vec2 CvdRule::centroid(const StarView& view, LocalIndex i) const {
  const double h = view.size(i);
  return view.is_uniform() ? move_by_triangles(view, i, CellFormula<double, false>(parameters(), h))
                           : move_by_triangles(view, i, CellFormula<double, true>(parameters(), h));
}

void CvdRule::begin_sweep(const SweepSums& sums) {
  momentum_.begin_sweep(sums);
}

Step CvdRule::step(const StarView& view, LocalIndex i) const {
  return momentum_.step(view, i, centroid(view, i));
}

RuleParameters CvdRule::parameters() const {
  RuleParameters rule;
  rule.kind = RuleParameters::Kind::cells;
  rule.exponent = exponent_;
  rule.momentum = momentum_.factor();
  return rule;
}

void TriangleRule::begin_sweep(const SweepSums& sums) {
  const double sizes = sums.squared_size_ratio.value(), lengths = sums.squared_length_ratio.value();
  area_scale_ = sizes > 0 && lengths > 0 ? lengths / sizes : 1;
  momentum_.begin_sweep(sums);
}

Step TriangleRule::step(const StarView& view, LocalIndex i) const {
  const double h = view.size(i);
  const Vec2 move = view.is_uniform() ? move_by_triangles(view, i, TriangleFormula<double, false>(parameters(), h))
                                      : move_by_triangles(view, i, TriangleFormula<double, true>(parameters(), h));
  return momentum_.step(view, i, move);
}

RuleParameters TriangleRule::parameters() const {
  RuleParameters rule;
  rule.kind = RuleParameters::Kind::triangles;
  rule.area_scale = area_scale_;
  rule.momentum = momentum_.factor();
  return rule;
}

} // namespace trime::meshing
