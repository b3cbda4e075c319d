// SPDX-License-Identifier: BSD-3-Clause
// The pass of sweep_kernel.hpp for TRIME_LANES sites side by side. Included once by each file that is compiled for one
// kind of processor; all of it is local to that file.
#pragma once

#include "core/lanes.hpp"
#include "meshing/sweep_kernel.hpp"

namespace trime::meshing {
namespace {

constexpr int width = TRIME_LANES;
using V = lanes::Types<width>::Doubles;
using M = lanes::Types<width>::Mask;
constexpr int slots = 8;

/// Sites i, i+1, ... of which some are local; the others are doubled by one that is.
struct Group {
  LocalIndex site[width];
  unsigned local = 0;    // a bit for each
  bool bordered = false; // some of them
  int largest_degree = 0;
  V degree{};
};

TRIME_INLINE Group group_at(const SweepTask& task, LocalIndex i, LocalIndex end) {
  Group group;
  LocalIndex any = -1;
  for (int l = 0; l < width; ++l) {
    group.site[l] = -1;
    if (i + l < end && task.classes[i + l] >= task.least_class) {
      group.site[l] = any = i + l;
      group.local |= 1U << l;
      group.bordered |= task.classes[i + l] == SiteClass::bordered;
    }
  }
  if (any < 0)
    return group;
  for (int l = 0; l < width; ++l) {
    if (group.site[l] < 0)
      group.site[l] = any;
    const int degree = task.degrees[group.site[l]];
    group.degree[l] = degree;
    group.largest_degree = degree > group.largest_degree ? degree : group.largest_degree;
  }
  return group;
}

/// The positions (or h) of one neighbour of each site of a group.
TRIME_INLINE lanes::Pairs<V> load_neighbours(const SweepTask& task, const Group& group, int slot) {
  const double* from[width];
  for (int l = 0; l < width; ++l)
    from[l] = &task.positions[task.rings[slots * std::ptrdiff_t{group.site[l]} + slot]].x;
  return lanes::load_pairs<V>(from);
}
TRIME_INLINE V load_sizes(const SweepTask& task, const Group& group, int slot) {
  V h{};
  for (int l = 0; l < width; ++l)
    h[l] = task.sizes[task.rings[slots * std::ptrdiff_t{group.site[l]} + slot]];
  return h;
}

TRIME_INLINE V load_own_sizes(const SweepTask& task, const Group& group) {
  V h{};
  for (int l = 0; l < width; ++l)
    h[l] = task.sizes[group.site[l]];
  return h;
}

/// The positions of the sites of a group.
TRIME_INLINE lanes::Pairs<V> load_sites(const geometry::Vec2* all, const Group& group) {
  const double* from[width];
  for (int l = 0; l < width; ++l)
    from[l] = &all[group.site[l]].x;
  return lanes::load_pairs<V>(from);
}

/// @brief The test of StarKernel::is_locally_convex for the stars of a group, spoke by spoke; and besides, that every
/// triangle is smaller than the cap and the first neighbour still is the lexicographically smallest.
class ConvexityTest {
public:
  TRIME_INLINE explicit ConvexityTest(V cap) : four_squared_caps_(4.0 * 0.98 * cap * cap) {}

  /// Spokes a, b, q in a row; `ab`, `bq` the cross products.
  TRIME_INLINE void add(const Spoke<V>& a, const Spoke<V>& b, const Spoke<V>& q, V ab, V bq, const Spoke<V>& first,
                        M active) {
    constexpr double epsilon = 0x1p-53;
    const V qa = q.x * a.y - q.y * a.x;
    const V determinant = a.squared * bq + b.squared * qa + q.squared * ab;
    const V product = a.squared * b.squared;
    const V magnitude = product + b.squared * q.squared + q.squared * a.squared;
    const V ex = a.x - b.x, ey = a.y - b.y;
    const M convex = determinant > (20 * epsilon) * magnitude, turned = ab > 1e-7 * (a.squared + b.squared);
    const M small = product * (ex * ex + ey * ey) < four_squared_caps_ * (ab * ab);
    const M smaller = (a.x < first.x) | ((a.x == first.x) & (a.y < first.y));
    bad_ |= active & (~(convex & turned & small) | smaller);
    turns_ -= active & (a.y < 0.0) & (b.y >= 0.0);
  }
  TRIME_INLINE unsigned good() const { return ~lanes::bits(bad_ | (turns_ != 1)); }

private:
  V four_squared_caps_;
  M bad_{}, turns_{};
};

/// Moves the local sites of a group; returns those whose stars it cannot certify, a bit for each.
template <template <class, bool> class Formula, bool graded>
TRIME_INLINE unsigned sweep_group(const SweepTask& task, const Group& group, LocalIndex begin,
                                  SweepLeftovers& leftovers, SweepTally& tally, V& largest_ratio, V& largest_distance,
                                  M& power) {
  const lanes::Pairs<V> p = load_sites(task.positions, group);
  V own = V{} + task.uniform_size;
  if constexpr (graded)
    own = load_own_sizes(task, group);
  const V uncapped = task.cap_factor * own, all_caps = V{} + task.largest_cap;
  ConvexityTest test(lanes::select(uncapped < all_caps, uncapped, all_caps));
  Formula<V, graded> formula(task.rule, own);

  const int n = group.largest_degree;
  Spoke<V> spoke[slots + 2];
  for (int k = 0; k < slots; ++k) {
    if (k >= n + 2)
      break;
    const lanes::Pairs<V> at = load_neighbours(task, group, k);
    const V x = at.x - p.x, y = at.y - p.y;
    spoke[k] = {x, y, x * x + y * y, own};
    if constexpr (graded)
      spoke[k].size = load_sizes(task, group, k);
  }
  if (n + 2 > slots) { // beyond the last slot the ring of 8 begins again, that of 7 is at its second
    const M eight = group.degree == 8.0;
    spoke[slots] = {lanes::select(eight, spoke[0].x, spoke[1].x), lanes::select(eight, spoke[0].y, spoke[1].y),
                    lanes::select(eight, spoke[0].squared, spoke[1].squared),
                    lanes::select(eight, spoke[0].size, spoke[1].size)};
    spoke[slots + 1] = spoke[1];
  }
  V cross = spoke[0].x * spoke[1].y - spoke[0].y * spoke[1].x;
  for (int k = 0; k < n; ++k) {
    const Spoke<V>&a = spoke[k], &b = spoke[k + 1], &q = spoke[k + 2];
    const M active = group.degree > static_cast<double>(k);
    const V next_cross = b.x * q.y - b.y * q.x;
    test.add(a, b, q, cross, next_cross, spoke[0], active);
    formula.add(a, b, cross, active);
    cross = next_cross;
  }

  const Move<V> move = formula.move();
  lanes::Pairs<V> lead{};
  if (task.leads)
    lead = load_sites(task.leads, group);
  V next_lead_x = task.rule.momentum * (move.x + lead.x), next_lead_y = task.rule.momentum * (move.y + lead.y);
  const V limit = (move_cap * own) * (move_cap * own), way_x = move.x + next_lead_x, way_y = move.y + next_lead_y;
  const V squared_way = way_x * way_x + way_y * way_y;
  const M is_short = (move.x * move.x + move.y * move.y <= limit) & (squared_way <= limit);
  const M rests = squared_way < (rest * own) * (rest * own);
  const auto clamp = [](V v, double low, double high) {
    const V above = lanes::select(v > low, v, V{} + low);
    return lanes::select(above < high, above, V{} + high);
  };
  const auto snap = [&](V v) { return lanes::nearest(v * task.inverse_lattice_step) * task.lattice_step; };
  const V x = lanes::select(rests, p.x, snap(clamp(p.x + way_x, task.box.min.x, task.box.max.x)));
  const V y = lanes::select(rests, p.y, snap(clamp(p.y + way_y, task.box.min.y, task.box.max.y)));
  next_lead_x = lanes::select(rests, V{}, next_lead_x);
  next_lead_y = lanes::select(rests, V{}, next_lead_y);

  const unsigned certified = group.local & test.good();
  const unsigned moved = certified & lanes::bits(is_short);
  unsigned guarded = 0;
  if (task.guard_cells) {
    const V column = (x - task.guard_corner.x) * task.guard_inverse_side;
    const V row = (y - task.guard_corner.y) * task.guard_inverse_side;
    for (int l = 0; l < width; ++l) {
      if (!(moved >> l & 1))
        continue;
      const bool known = column[l] >= 0 && row[l] >= 0 && column[l] < task.guard_columns && row[l] < task.guard_rows;
      if (!known || task.guard_cells[static_cast<std::int64_t>(row[l]) * task.guard_columns +
                                     static_cast<std::int64_t>(column[l])] <= 0)
        guarded |= 1U << l;
    }
  }
  const SiteTally<V> one(x - p.x, y - p.y, lead.x, lead.y, next_lead_x, next_lead_y, own);
  M counted{};
  for (int l = 0; l < width; ++l) {
    counted[l] = -static_cast<std::int64_t>(moved >> l & 1);
    if (moved >> l & 1) {
      task.next_positions[begin + l] = {x[l], y[l]};
      if (task.next_leads)
        task.next_leads[begin + l] = {next_lead_x[l], next_lead_y[l]};
      if (guarded >> l & 1)
        leftovers.guarded[leftovers.guarded_count++] = begin + l;
    } else if (certified >> l & 1) {
      leftovers.irregular[leftovers.irregular_count++] = begin + l;
    }
  }
  tally.moving -= lanes::sum_of_lanes(counted & (one.squared_ratio > still * still));
  power += counted & lanes::fixed_point(one.power);
  largest_ratio = lanes::select(counted & (one.squared_ratio > largest_ratio), one.squared_ratio, largest_ratio);
  largest_distance =
      lanes::select(counted & (one.squared_distance > largest_distance), one.squared_distance, largest_distance);
  return group.local & ~certified;
}

template <template <class, bool> class Formula, bool graded>
SweepTally sweep_range(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers) {
  SweepTally tally;
  V ratio{}, distance{};
  M power{};
  for (LocalIndex i = begin; i < end; i += width) {
    const Group group = group_at(task, i, end);
    unsigned suspects = 0; // a bit for each site of the group
    for (LocalIndex j = i; j < i + width && j < end; ++j) {
      if (group.local >> (j - i) & 1)
        continue;
      task.next_positions[j] = task.positions[j];
      if (task.next_leads)
        task.next_leads[j] = {};
      if (task.classes[j] != SiteClass::held)
        suspects |= 1U << (j - i);
    }
    if (group.local)
      suspects |= sweep_group<Formula, graded>(task, group, i, leftovers, tally, ratio, distance, power);
    for (int l = 0; suspects; ++l, suspects >>= 1)
      if (suspects & 1)
        leftovers.suspects[leftovers.suspect_count++] = i + l;
  }
  tally.power = lanes::sum_of_lanes(power);
  tally.squared_ratio = lanes::largest_lane(ratio);
  tally.squared_distance = lanes::largest_lane(distance);
  return tally;
}

SweepTally sweep_lanes(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers) {
  using Kind = RuleParameters::Kind;
  const bool graded = task.sizes != nullptr;
  switch (task.rule.kind) {
  case Kind::bars:
    return graded ? sweep_range<BarFormula, true>(task, begin, end, leftovers)
                  : sweep_range<BarFormula, false>(task, begin, end, leftovers);
  case Kind::cells:
    return graded ? sweep_range<CellFormula, true>(task, begin, end, leftovers)
                  : sweep_range<CellFormula, false>(task, begin, end, leftovers);
  case Kind::triangles:
    break;
  }
  return graded ? sweep_range<TriangleFormula, true>(task, begin, end, leftovers)
                : sweep_range<TriangleFormula, false>(task, begin, end, leftovers);
}

} // namespace
} // namespace trime::meshing
