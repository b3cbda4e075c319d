// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/update_rule.hpp"

#include "sweep/rule_formulas.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using sites::StarView;

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

/// A scale stays as it is until it would change by a share that counts: where nothing moves a rule then wants the same
/// in each sweep, bit for bit.
double steadied(double before, double now) {
  return std::fabs(now - before) > SweepRules::scale_change * before ? now : before;
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

void Momentum::begin_sweep(const SweepSums& sums) {
  if (sums.power.value() > 0)
    age_ = 0;
  factor_ = std::min(SweepRules::largest_momentum, static_cast<double>(age_) / (age_ + SweepRules::momentum_delay));
  ++age_;
}

Step Momentum::step(const StarView& view, LocalIndex i, Vec2 move) const {
  return {move, factor_ * (move + view.points.leads()[static_cast<std::size_t>(i)])};
}

void DistMeshRule::begin_sweep(const SweepSums& sums) {
  const double sizes = sums.squared_size_ratio.value();
  length_scale_ = steadied(length_scale_,
                           sizes > 0 ? SweepRules::bar_pressure * std::sqrt(sums.squared_length_ratio.value() / sizes)
                                     : SweepRules::bar_pressure);
}

Step DistMeshRule::step(const StarView& view, LocalIndex i) const {
  const double h = view.size(i);
  return {view.is_uniform() ? force(view, i, BarFormula<double, false>(parameters(), h))
                            : force(view, i, BarFormula<double, true>(parameters(), h)),
          {}};
}

RuleParameters DistMeshRule::parameters() const {
  RuleParameters rule;
  rule.mover = Mover::bars;
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
  rule.mover = Mover::cells;
  rule.exponent = exponent_;
  rule.momentum = momentum_.factor();
  return rule;
}

void TriangleRule::begin_sweep(const SweepSums& sums) {
  const double sizes = sums.squared_size_ratio.value(), lengths = sums.squared_length_ratio.value();
  area_scale_ = steadied(area_scale_, sizes > 0 && lengths > 0 ? lengths / sizes : 1);
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
  rule.mover = Mover::triangles;
  rule.area_scale = area_scale_;
  rule.momentum = momentum_.factor();
  return rule;
}

} // namespace trime::sweep
