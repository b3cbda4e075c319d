// SPDX-License-Identifier: BSD-3-Clause
// Implements the kernels of sweep_kernel.hpp for TRIME_LANES sites at once. Each source file that is compiled for one
// kind of processor includes this header once; all names in this header are local to that source file.
#pragma once

#include "sweep/site_group.hpp"

#include <cstring>

namespace trime::sweep {
namespace {

/// Says which of some consecutive sites must be processed, with one bit per site.
struct Waking {
  unsigned awake = 0;  // bit set: the update rule may move the site
  unsigned wanted = 0; // bit set: the rule may move the site, or its star must be certified
};

TRIME_INLINE Waking waking_at(const SweepTask& task, LocalIndex i, LocalIndex end) {
  Waking waking;
  for (int l = 0; l < width && i + l < end; ++l) {
    waking.awake |= static_cast<unsigned>((task.flags[i + l] & SiteFlags::awake) != 0) << l;
    waking.wanted |= static_cast<unsigned>(!SiteFlags::is_asleep(task.flags[i + l])) << l;
  }
  return waking;
}

/// Returns true if all sites of the group at i sleep and their places are already copied. Returns false for an
/// incomplete group at the end of a range.
TRIME_INLINE bool is_copied(const SweepTask& task, LocalIndex i, LocalIndex end) {
  std::uint64_t found = 0, copied = 0;
  static_assert(width <= sizeof found);
  if (i + width > end)
    return false;
  std::memcpy(&found, task.flags + i, width);
  std::memset(&copied, SiteFlags::copied, width);
  return found == copied;
}

/// The next places of the sites of a group.
struct GroupMove {
  V x, y;                     // next places
  lanes::Pairs<V> lead{};     // momentum parts of the steps before the move
  V next_lead_x, next_lead_y; // momentum parts of the steps after the move
  M is_short;                 // neither the move alone nor the move plus its lead exceeds the longest allowed move
  M rests;                    // the site stays at rest, see surely_rests
};

TRIME_INLINE V clamped(V v, double low, double high) {
  const V above = lanes::select(v > low, v, V{} + low);
  return lanes::select(above < high, above, V{} + high);
}

TRIME_INLINE V snapped(const SweepTask& task, V v) {
  return lanes::nearest(v * task.inverse_lattice_step) * task.lattice_step;
}

/// Adds momentum to the move of the update rule and rounds the next place to the coordinate lattice. Very short moves
/// are not made, and sites that are not awake do not move.
TRIME_INLINE GroupMove next_places(const SweepTask& task, const Group& group, const lanes::Pairs<V>& p, V own,
                                   const Move<V>& move, M awake) {
  GroupMove next;
  if (task.leads)
    next.lead = load_sites(task.leads, group);
  const lanes::Pairs<V>& lead = next.lead;
  const V next_lead_x = task.rule.momentum * (move.x + lead.x), next_lead_y = task.rule.momentum * (move.y + lead.y);
  const V limit = (SweepRules::move_cap * own) * (SweepRules::move_cap * own);
  const V way_x = move.x + next_lead_x, way_y = move.y + next_lead_y;
  const V squared_way = way_x * way_x + way_y * way_y;
  next.is_short = ~awake | ((move.x * move.x + move.y * move.y <= limit) & (squared_way <= limit));
  const M rests = ~awake | (squared_way < (SweepRules::rest * own) * (SweepRules::rest * own));
  next.rests = rests & surely_rests(move.x, move.y, own);
  next.x = lanes::select(rests, p.x, snapped(task, clamped(p.x + way_x, task.box.min.x, task.box.max.x)));
  next.y = lanes::select(rests, p.y, snapped(task, clamped(p.y + way_y, task.box.min.y, task.box.max.y)));
  next.next_lead_x = lanes::select(rests, V{}, next_lead_x);
  next.next_lead_y = lanes::select(rests, V{}, next_lead_y);
  return next;
}

/// Returns one bit for each lane of `moved` whose new place may lie in the diametral circle of a boundary edge.
TRIME_INLINE unsigned guarded_lanes(const SweepTask& task, unsigned moved, V x, V y) {
  unsigned guarded = 0;
  if (!task.guard.states)
    return guarded;
  const V column = (x - task.guard.corner.x) * task.guard.inverse_side;
  const V row = (y - task.guard.corner.y) * task.guard.inverse_side;
  for (int l = 0; l < width; ++l) {
    if (!(moved >> l & 1))
      continue;
    const bool known = column[l] >= 0 && row[l] >= 0 && column[l] < task.guard.columns && row[l] < task.guard.rows;
    if (!known || task.guard.states[static_cast<std::int64_t>(row[l]) * task.guard.columns +
                                    static_cast<std::int64_t>(column[l])] <= 0)
      guarded |= 1U << l;
  }
  return guarded;
}

/// Stores the moves of the lanes in `moved`, and lists the sites that the caller must treat.
TRIME_INLINE M store_moves(const SweepTask& task, LocalIndex begin, unsigned certified, unsigned moved,
                           const GroupMove& next, SweepLeftovers& leftovers) {
  const unsigned guarded = guarded_lanes(task, moved, next.x, next.y);
  M counted{};
  for (int l = 0; l < width; ++l) {
    counted[l] = -static_cast<std::int64_t>(moved >> l & 1);
    if (moved >> l & 1) {
      task.next_positions[begin + l] = {next.x[l], next.y[l]};
      if (task.next_leads)
        task.next_leads[begin + l] = {next.next_lead_x[l], next.next_lead_y[l]};
      if (guarded >> l & 1)
        leftovers.guarded[leftovers.guarded_count++] = begin + l;
    } else if (certified >> l & 1) {
      leftovers.irregular[leftovers.irregular_count++] = begin + l;
    }
  }
  return counted;
}

/// Stores for the local sites of a group what the next sweep must do with them.
TRIME_INLINE void store_flags(const SweepTask& task, LocalIndex begin, unsigned local, unsigned certified,
                              unsigned resting) {
  for (int l = 0; l < width; ++l) {
    if (!(local >> l & 1))
      continue;
    std::uint8_t& flags = task.flags[begin + l];
    const bool stays_awake = (flags & SiteFlags::awake) && !((certified & resting) >> l & 1),
               is_watched = !(certified >> l & 1) || task.classes[begin + l] != SiteClass::local;
    flags = static_cast<std::uint8_t>((stays_awake ? SiteFlags::awake : 0) | (is_watched ? SiteFlags::watched : 0));
  }
}

/// Sums over the moves of a range of sites, with one sum for each vector lane.
struct LaneTally {
  std::int64_t moving = 0;
  M power{};
  V ratio{}, distance{};

  TRIME_INLINE void add(const SiteTally<V>& one, M counted) {
    moving -= lanes::sum_of_lanes(counted & (one.squared_ratio > SweepRules::still * SweepRules::still));
    power += counted & lanes::fixed_point(one.power);
    ratio = lanes::select(counted & (one.squared_ratio > ratio), one.squared_ratio, ratio);
    distance = lanes::select(counted & (one.squared_distance > distance), one.squared_distance, distance);
  }
  TRIME_INLINE SweepTally sum() const {
    SweepTally tally;
    tally.moving = moving;
    tally.power = lanes::sum_of_lanes(power);
    tally.squared_ratio = lanes::largest_lane(ratio);
    tally.squared_distance = lanes::largest_lane(distance);
    return tally;
  }
};

/// Converts one bit for each lane to a mask.
TRIME_INLINE M mask_of(unsigned lanes) {
  M mask;
  for (int l = 0; l < width; ++l)
    mask[l] = -static_cast<std::int64_t>(lanes >> l & 1);
  return mask;
}

/// Moves the local sites of a group that are awake. Returns one bit for each site whose star the kernel cannot certify.
template <template <class, bool> class Formula, bool graded>
TRIME_INLINE unsigned sweep_group(const SweepTask& task, const Group& group, unsigned awake, LocalIndex begin,
                                  SweepLeftovers& leftovers, LaneTally& tally) {
  const lanes::Pairs<V> p = load_sites(task.positions, group);
  const V own = sizes_of<graded>(task, group);
  ConvexityTest test(caps_of(task, own));
  Formula<V, graded> formula(task.rule, own);
  Spoke<V> spoke[slots + 2];
  load_spokes<graded>(task, group, p, own, spoke);
  visit_triangles(group, spoke, test, formula);

  const GroupMove next = next_places(task, group, p, own, formula.move(), mask_of(awake));
  const unsigned certified = group.local & test.good();
  const unsigned moved = certified & lanes::bits(next.is_short);
  const M counted = store_moves(task, begin, certified, moved, next, leftovers);
  tally.add({next.x - p.x, next.y - p.y, next.lead.x, next.lead.y, next.next_lead_x, next.next_lead_y, own}, counted);
  store_flags(task, begin, group.local, certified, lanes::bits(next.rests));
  return group.local & ~certified;
}

/// Keeps the places of those sites of [begin, end) that are asleep or not local. Returns one bit for each site whose
/// star the caller must certify.
TRIME_INLINE unsigned hold_others(const SweepTask& task, const Group& group, LocalIndex begin, LocalIndex end) {
  unsigned with_stars = 0;
  for (LocalIndex i = begin; i < begin + width && i < end; ++i) {
    if (group.local >> (i - begin) & 1 || task.flags[i] == SiteFlags::copied)
      continue;
    task.next_positions[i] = task.positions[i];
    if (task.next_leads)
      task.next_leads[i] = {};
    if (SiteFlags::is_asleep(task.flags[i]))
      task.flags[i] = SiteFlags::copied;
    else if (task.classes[i] != SiteClass::held)
      with_stars |= 1U << (i - begin);
  }
  return with_stars;
}

/// Appends to a list the sites of the lanes in `listed`, for the group whose first site is `begin`.
TRIME_INLINE void append(LocalIndex begin, unsigned listed, LocalIndex* list, std::ptrdiff_t& count) {
  for (LocalIndex i = begin; listed; ++i, listed >>= 1)
    if (listed & 1)
      list[count++] = i;
}

template <template <class, bool> class Formula, bool graded>
SweepTally sweep_range(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers) {
  LaneTally tally;
  for (LocalIndex i = begin; i < end; i += width) {
    if (is_copied(task, i, end))
      continue;
    const Waking waking = waking_at(task, i, end);
    leftovers.awake_count += __builtin_popcount(waking.awake);
    const Group group = group_at(task, i, end, waking.wanted);
    unsigned suspects = hold_others(task, group, i, end);
    if (group.local)
      suspects |= sweep_group<Formula, graded>(task, group, waking.awake, i, leftovers, tally);
    append(i, suspects, leftovers.suspects, leftovers.suspect_count);
  }
  return tally.sum();
}

SweepTally sweep_lanes(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers) {
  const bool graded = task.sizes != nullptr;
  switch (task.rule.mover) {
  case Mover::bars:
    return graded ? sweep_range<BarFormula, true>(task, begin, end, leftovers)
                  : sweep_range<BarFormula, false>(task, begin, end, leftovers);
  case Mover::cells:
    return graded ? sweep_range<CellFormula, true>(task, begin, end, leftovers)
                  : sweep_range<CellFormula, false>(task, begin, end, leftovers);
  case Mover::triangles:
    break;
  }
  return graded ? sweep_range<TriangleFormula, true>(task, begin, end, leftovers)
                : sweep_range<TriangleFormula, false>(task, begin, end, leftovers);
}

/// Takes the place of an update rule when stars are only certified and no site moves.
struct NoFormula {
  TRIME_INLINE void add(const Spoke<V>&, const Spoke<V>&, V, M) {}
};

/// Returns one bit for each local site of a group whose star the kernel cannot certify.
template <bool graded>
TRIME_INLINE unsigned suspects_of(const SweepTask& task, const Group& group) {
  const lanes::Pairs<V> p = load_sites(task.positions, group);
  const V own = sizes_of<graded>(task, group);
  ConvexityTest test(caps_of(task, own));
  NoFormula formula;
  Spoke<V> spoke[slots + 2];
  load_spokes<false>(task, group, p, own, spoke);
  visit_triangles(group, spoke, test, formula);
  return group.local & ~test.good();
}

template <bool graded>
std::ptrdiff_t certify_range(const SweepTask& task, LocalIndex begin, LocalIndex end, LocalIndex* suspects) {
  std::ptrdiff_t count = 0;
  for (LocalIndex i = begin; i < end; i += width) {
    const Group group = group_at(task, i, end);
    unsigned found = group.local ? suspects_of<graded>(task, group) : 0;
    for (LocalIndex j = i; j < i + width && j < end; ++j)
      if (!(group.local >> (j - i) & 1) && task.classes[j] != SiteClass::held)
        found |= 1U << (j - i);
    append(i, found, suspects, count);
  }
  return count;
}

std::ptrdiff_t certify_lanes(const SweepTask& task, LocalIndex begin, LocalIndex end, LocalIndex* suspects) {
  return task.sizes ? certify_range<true>(task, begin, end, suspects)
                    : certify_range<false>(task, begin, end, suspects);
}

struct QualityLanes {
  M squared_lengths{}, squared_sizes{}, excess{};
  V largest{};
  std::int64_t triangles = 0;
};

TRIME_INLINE V at_most(V v, double limit) {
  return lanes::select(v < limit, v, V{} + limit);
}

/// Finds the lanes whose neighbour comes after the site in lexicographic order. A neighbour on the boundary always
/// counts as later, because triangles are not counted at boundary sites.
TRIME_INLINE M comes_after(const SweepTask& task, const Group& group, const Spoke<V>& a, int slot) {
  M after = (a.x > 0.0) | ((a.x == 0.0) & (a.y > 0.0));
  if (group.bordered)
    for (int l = 0; l < width; ++l)
      if (task.boundary[task.rings[slots * std::ptrdiff_t{group.site[l]} + slot]] >= 0)
        after[l] = -1;
  return after;
}

template <bool graded>
TRIME_INLINE void measure_group(const SweepTask& task, const Group& group, double inverse_reference, QualityLanes& sums,
                                double* excesses) {
  const lanes::Pairs<V> p = load_sites(task.positions, group);
  const double inverse_area = inverse_reference * inverse_reference;
  const V own = sizes_of<graded>(task, group);
  const auto spoke_at = [&](int slot) {
    const lanes::Pairs<V> at = load_neighbours(task, group, slot);
    const V x = at.x - p.x, y = at.y - p.y;
    return Spoke<V>{x, y, x * x + y * y, own};
  };
  M is_local{};
  for (int l = 0; l < width; ++l)
    is_local[l] = -static_cast<std::int64_t>(group.local >> l & 1);

  const Spoke<V> first = spoke_at(0);
  Spoke<V> a = first;
  M a_after = comes_after(task, group, a, 0);
  for (int k = 0; k < group.largest_degree; ++k) {
    const M active = is_local & (group.degree > static_cast<double>(k));
    const Spoke<V> b = k + 1 < slots ? spoke_at(k + 1) : first;
    const M b_after = comes_after(task, group, b, k + 1 < slots ? k + 1 : 0);
    V h = own * inverse_reference;
    if constexpr (graded)
      h = 0.5 * (own + load_sizes(task, group, k)) * inverse_reference;
    sums.squared_lengths += active & lanes::fixed_point(at_most(a.squared * inverse_area, SweepRules::largest_term));
    sums.squared_sizes += active & lanes::fixed_point(at_most(h * h, SweepRules::largest_term));
    const M counted = active & a_after & b_after;
    if (unsigned found = lanes::bits(counted)) {
      const V excess = excess_of_alpha(a, b, a.x * b.y - a.y * b.x);
      sums.excess += counted & lanes::fixed_point(at_most(excess, SweepRules::largest_excess_term));
      sums.largest = lanes::select(counted & (excess > sums.largest), excess, sums.largest);
      for (; found; found &= found - 1)
        excesses[sums.triangles++] = excess[__builtin_ctz(found)];
    }
    a = b;
    a_after = b_after;
  }
}

template <bool graded>
QualityTally measure_range(const SweepTask& task, LocalIndex begin, LocalIndex end, double inverse_reference,
                           double* excesses) {
  QualityLanes sums;
  for (LocalIndex i = begin; i < end; i += width) {
    const Group group = group_at(task, i, end);
    if (group.local)
      measure_group<graded>(task, group, inverse_reference, sums, excesses);
  }
  return {lanes::sum_of_lanes(sums.squared_lengths), lanes::sum_of_lanes(sums.squared_sizes),
          lanes::sum_of_lanes(sums.excess), sums.triangles, lanes::largest_lane(sums.largest)};
}

QualityTally measure_lanes(const SweepTask& task, LocalIndex begin, LocalIndex end, double inverse_reference,
                           double* excesses) {
  return task.sizes ? measure_range<true>(task, begin, end, inverse_reference, excesses)
                    : measure_range<false>(task, begin, end, inverse_reference, excesses);
}

} // namespace

} // namespace trime::sweep
