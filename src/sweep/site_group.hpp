// SPDX-License-Identifier: BSD-3-Clause
// Processes TRIME_LANES sites at once with their stars, and tests these stars. Each source file that is compiled for
// one kind of processor includes this header once; all names in this header are local to that source file.
#pragma once

#include "core/lanes.hpp"
#include "delaunay/rules.hpp"
#include "sweep/sweep_kernel.hpp"

namespace trime::sweep {
namespace {

constexpr int width = TRIME_LANES;
using V = lanes::Types<width>::Doubles;
using M = lanes::Types<width>::Mask;
constexpr int slots = 8;

/// A group of the sites i, i + 1, ..., one in each vector lane. A lane whose own site is not of the class `local` holds
/// another local site, and its result is ignored.
struct Group {
  LocalIndex site[width];
  unsigned local = 0;    // one bit for each lane whose own site is of the class `local`
  bool bordered = false; // true if some of the sites have the class `bordered`
  int largest_degree = 0;
  V degree{};
};

/// Returns the group that begins at site i.
/// @param wanted one bit for each lane; lanes without their bit count as not local
TRIME_INLINE Group group_at(const SweepTask& task, LocalIndex i, LocalIndex end, unsigned wanted = ~0U) {
  Group group;
  LocalIndex any = -1;
  for (int l = 0; l < width; ++l) {
    group.site[l] = -1;
    if (i + l < end && (wanted >> l & 1) && task.classes[i + l] >= task.least_class) {
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

/// Loads the position (or, below, the target edge length h) of one neighbour of each site of a group.
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

/// Loads the positions of the sites of a group.
TRIME_INLINE lanes::Pairs<V> load_sites(const geometry::Vec2* all, const Group& group) {
  const double* from[width];
  for (int l = 0; l < width; ++l)
    from[l] = &all[group.site[l]].x;
  return lanes::load_pairs<V>(from);
}

/// @brief Tests the stars of a group of sites, neighbour by neighbour. The neighbours must wind once around the site,
/// and the star must be locally convex, as in StarKernel::is_locally_convex. Each circumradius must be below the cap of
/// the star, and the first neighbour must still be the lexicographically smallest.
class ConvexityTest {
public:
  TRIME_INLINE explicit ConvexityTest(V cap) : four_squared_caps_(4.0 * SweepRules::cap_margin * cap * cap) {}

  /// Adds the consecutive neighbours a, b, q; `ab` and `bq` are the cross products of a with b and of b with q.
  TRIME_INLINE void add(const Spoke<V>& a, const Spoke<V>& b, const Spoke<V>& q, V ab, V bq, const Spoke<V>& first,
                        M active) {
    const V qa = q.x * a.y - q.y * a.x;
    const V determinant = a.squared * bq + b.squared * qa + q.squared * ab;
    const V product = a.squared * b.squared;
    const V magnitude = product + b.squared * q.squared + q.squared * a.squared;
    const V ex = a.x - b.x, ey = a.y - b.y;
    const M convex = determinant > delaunay::ConvexityRules::error * magnitude,
            turned = ab > delaunay::ConvexityRules::least_turn * (a.squared + b.squared);
    const M small = product * (ex * ex + ey * ey) < four_squared_caps_ * (ab * ab);
    const M smaller = (a.x < first.x) | ((a.x == first.x) & (a.y < first.y));
    bad_ |= active & (~(convex & turned & small) | smaller);
    turns_ -= active & (a.y < 0.0) & (b.y >= 0.0);
  }
  /// Returns one bit for each lane, which is set if the star in the lane passes the test.
  TRIME_INLINE unsigned good() const { return ~lanes::bits(bad_ | (turns_ != 1)); }

private:
  V four_squared_caps_;
  M bad_{}, turns_{};
};

/// Returns the target edge length h at the sites of a group.
template <bool graded>
TRIME_INLINE V sizes_of(const SweepTask& task, const Group& group) {
  if constexpr (graded)
    return load_own_sizes(task, group);
  return V{} + task.uniform_size;
}

/// Returns the largest allowed circumradius in each star of a group, see StarBuilder::cap.
TRIME_INLINE V caps_of(const SweepTask& task, V own_size) {
  const V uncapped = task.cap_factor * own_size, all_caps = V{} + task.largest_cap;
  return lanes::select(uncapped < all_caps, uncapped, all_caps);
}

/// Loads the vectors to the neighbours of a group of sites, slot by slot. Where a site has fewer neighbours than slots,
/// its neighbours are repeated from the first; at least the first two are repeated.
template <bool graded>
TRIME_INLINE void load_spokes(const SweepTask& task, const Group& group, const lanes::Pairs<V>& p, V own_size,
                              Spoke<V> (&spoke)[slots + 2]) {
  const int n = group.largest_degree;
  for (int k = 0; k < slots; ++k) {
    if (k >= n + 2)
      break;
    const lanes::Pairs<V> at = load_neighbours(task, group, k);
    const V x = at.x - p.x, y = at.y - p.y;
    spoke[k] = {x, y, x * x + y * y, own_size};
    if constexpr (graded)
      spoke[k].size = load_sizes(task, group, k);
  }
  if (n + 2 > slots) { // a ring of 8 neighbours begins again after the last slot, a ring of 7 continues with its second
                       // neighbour
    const M eight = group.degree == 8.0;
    spoke[slots] = {lanes::select(eight, spoke[0].x, spoke[1].x), lanes::select(eight, spoke[0].y, spoke[1].y),
                    lanes::select(eight, spoke[0].squared, spoke[1].squared),
                    lanes::select(eight, spoke[0].size, spoke[1].size)};
    spoke[slots + 1] = spoke[1];
  }
}

/// Passes every triangle in the stars of a group to the convexity test and to the formula of the update rule.
template <class Formula>
TRIME_INLINE void visit_triangles(const Group& group, const Spoke<V> (&spoke)[slots + 2], ConvexityTest& test,
                                  Formula& formula) {
  V cross = spoke[0].x * spoke[1].y - spoke[0].y * spoke[1].x;
  for (int k = 0; k < group.largest_degree; ++k) {
    const Spoke<V>&a = spoke[k], &b = spoke[k + 1], &q = spoke[k + 2];
    const M active = group.degree > static_cast<double>(k);
    const V next_cross = b.x * q.y - b.y * q.x;
    test.add(a, b, q, cross, next_cross, spoke[0], active);
    formula.add(a, b, cross, active);
    cross = next_cross;
  }
}

} // namespace
} // namespace trime::sweep
