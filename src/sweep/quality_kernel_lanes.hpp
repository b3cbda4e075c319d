// SPDX-License-Identifier: BSD-3-Clause
// The measuring pass of sweep_kernel.hpp for TRIME_LANES sites side by side. Included once by each file that is
// compiled for one kind of processor; all of it is local to that file.
#pragma once

#include "sweep/sweep_kernel_lanes.hpp"

namespace trime::sweep {
namespace {

struct QualityLanes {
  M squared_lengths{}, squared_sizes{}, excess{};
  V largest{};
  std::int64_t triangles = 0;
};

TRIME_INLINE V at_most(V v, double limit) {
  return lanes::select(v < limit, v, V{} + limit);
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
  const auto comes_after = [&](const Spoke<V>& a, int slot) { // boundary sites measure nothing
    M after = (a.x > 0.0) | ((a.x == 0.0) & (a.y > 0.0));
    if (group.bordered)
      for (int l = 0; l < width; ++l)
        if (task.boundary[task.rings[slots * std::ptrdiff_t{group.site[l]} + slot]] >= 0)
          after[l] = -1;
    return after;
  };
  M is_local{};
  for (int l = 0; l < width; ++l)
    is_local[l] = -static_cast<std::int64_t>(group.local >> l & 1);

  const Spoke<V> first = spoke_at(0);
  Spoke<V> a = first;
  M a_after = comes_after(a, 0);
  for (int k = 0; k < group.largest_degree; ++k) {
    const M active = is_local & (group.degree > static_cast<double>(k));
    const Spoke<V> b = k + 1 < slots ? spoke_at(k + 1) : first;
    const M b_after = comes_after(b, k + 1 < slots ? k + 1 : 0);
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
