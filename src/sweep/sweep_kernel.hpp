// SPDX-License-Identifier: BSD-3-Clause
// Declares the vector kernels of a sweep. In one pass over the sites of a tile, a
// kernel certifies their stars at the present positions and moves the sites. A kernel processes several sites at once;
// the bits of the result do not depend on how many.
#pragma once

#include "core/simd_level.hpp"
#include "polygon/disc_cells.hpp"
#include "sweep/rule_formulas.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <cstdint>

namespace trime::sweep {

/// Says how a sweep treats a site.
enum class SiteClass : std::uint8_t {
  held,     ///< a boundary site: does not move and has no star
  fixed,    ///< a fixed point of the user: does not move; its star needs the empty-circumcircle test
  exact,    ///< an inner site that moves; its star needs the empty-circumcircle test, because some of its neighbours
            ///< belong to other ranks
  bordered, ///< an inner site next to the boundary; treated as `local` while no site is in the diametral circle of a
            ///< boundary edge nearby
  local     ///< an inner site that moves; the local Delaunay test of its star and of the stars around it is enough
};

/// Bits that say what a sweep must do with a site. A site with neither `awake` nor `watched` is asleep: the sweep skips
/// it.
struct SiteFlags {
  static constexpr std::uint8_t awake = 1;   ///< the update rule may move the site
  static constexpr std::uint8_t watched = 2; ///< the star is certified even if nothing has moved, because the site is
                                             ///< not `local` or its star failed the local test
                                             // /< lemma did not do for it
  static constexpr std::uint8_t copied =
      4; ///< the site is asleep, and its present place and its next place are already the same
  TRIME_INLINE static constexpr bool is_asleep(std::uint8_t flags) { return (flags & (awake | watched)) == 0; }
};

/// The input and output of a kernel: arrays by local index of the sites, and values that are the same for all sites.
struct SweepTask {
  const geometry::Vec2* positions;
  const geometry::Vec2* leads; ///< null, like next_leads, if no site has a lead (momentum part of its step)
  const LocalIndex* rings;     ///< the neighbours of each site in 8 slots; fewer neighbours are repeated from the first
  const std::uint8_t* degrees;
  const SiteClass* classes; ///< class of each owned site
  const std::int32_t* boundary =
      nullptr; ///< number of the site on the boundary, as in BinnedPoints::boundary; used by QualityKernel only
  SiteClass least_class = SiteClass::local; ///< sites of a lower class are listed for the caller instead
  std::uint8_t* flags = nullptr; ///< SiteFlags, used by SweepKernel only; `held` sites are asleep, and sites of all
                                 ///< classes except `local` are watched
                                 // /< of all other classes but `local` are watched
  const double* sizes = nullptr; ///< target edge length at each site; null: uniform_size everywhere
  double uniform_size = 1;
  geometry::Vec2* next_positions;
  geometry::Vec2* next_leads;

  RuleParameters rule;
  double lattice_step = 1, inverse_lattice_step = 1;
  geometry::Box box;                      ///< no site leaves this box; infinite along periodic axes
  double cap_factor = 1, largest_cap = 1; ///< largest circumradius of a star's triangles, as in StarBuilder::cap

  polygon::GuardCells guard;
};

/// Sums over the moves of some sites. All sums are integers, so they may be added in any order.
struct SweepTally {
  std::int64_t moving = 0; ///< sites that moved by more than SweepRules::still
  std::int64_t power = 0;  ///< power of the moves in units of FixedSum, see class Momentum
  std::int64_t pushed = 0, deleted = 0;
  double squared_ratio = 0;    ///< largest squared move over h^2 of the site
  double squared_distance = 0; ///< largest squared move in domain units

  void add(const SweepTally& other) {
    moving += other.moving;
    power += other.power;
    pushed += other.pushed;
    deleted += other.deleted;
    squared_ratio = squared_ratio < other.squared_ratio ? other.squared_ratio : squared_ratio;
    squared_distance = squared_distance < other.squared_distance ? other.squared_distance : squared_distance;
  }
};

/// The contribution of one site to the sums. With V = double or a vector type, the bits are the same.
template <class V>
struct SiteTally {
  V squared_distance, squared_ratio, power;

  /// @param x, y move from the old place to the new one
  /// @param lead_x, lead_y lead before the move
  /// @param next_lead_x, next_lead_y lead after the move
  TRIME_INLINE SiteTally(V x, V y, V lead_x, V lead_y, V next_lead_x, V next_lead_y, V h) {
    const V inverse = 1.0 / (h * h), move_x = x - next_lead_x, move_y = y - next_lead_y;
    squared_distance = x * x + y * y;
    squared_ratio = squared_distance * inverse;
    const V raw = -(move_x * (move_x + lead_x) + move_y * (move_y + lead_y)) * inverse;
    const V low = V{} - SweepRules::largest_power, high = V{} + SweepRules::largest_power;
    const V above = lanes::select(raw > low, raw, low);
    power = lanes::select(above < high, above, high);
  }
};

/// Returns whether a site with this move stays at rest for any value of the momentum. Such a site need not be examined
/// again until the site, one of its neighbours, its star or the update rule changes.
template <class V>
TRIME_INLINE auto surely_rests(V move_x, V move_y, V h) {
  static_assert((1 + SweepRules::largest_momentum) * SweepRules::rest_share < 1);
  const V limit = (SweepRules::rest_share * SweepRules::rest) * h;
  return move_x * move_x + move_y * move_y < limit * limit;
}

/// Sites that a kernel lists for its caller instead of moving them. Each list is ascending, whatever the number of
/// vector lanes. The caller provides room for all sites of the range in each list.
struct SweepLeftovers {
  LocalIndex* suspects;  ///< sites whose stars need the empty-circumcircle test before they move
  LocalIndex* irregular; ///< sites with certified stars whose move would be too long; the kernel has not moved them
  LocalIndex*
      guarded; ///< sites that the kernel moved to a place near the boundary, from which they may have to be pushed
  std::ptrdiff_t suspect_count = 0, irregular_count = 0, guarded_count = 0;
  std::ptrdiff_t awake_count = 0; ///< number of sites that were awake
};

/// @brief Certifies the local sites of [begin, end) by the Delaunay lemma and computes their next positions and leads.
/// The lemma says that a triangulation is Delaunay if every star winds once, counter-clockwise, and is locally convex
/// (Delaunay 1934). A site that the kernel does not move keeps its place. A site that surely rests falls asleep. Cost:
/// about 10 ns per site in addition to the rule, and less than 1 ns for a sleeping site among other sleeping ones.
/// @pre two neighbouring local sites always list each other as neighbours
/// @return the sums over the sites that the kernel has moved
using SweepKernel = SweepTally (*)(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers);

/// @brief Certifies the stars of [begin, end) by the Delaunay lemma without moving sites. `suspects` receives the sites
/// whose stars need the empty-circumcircle test, in ascending order, and must have room for all sites. The task needs
/// no update rule, leads or next places. Cost: about 10 ns per site.
/// @return number of entries written to `suspects`
using CertifyKernel = std::ptrdiff_t (*)(const SweepTask& task, LocalIndex begin, LocalIndex end, LocalIndex* suspects);

/// Sums over the stars of some sites, in units of FixedSum; SweepSums describes each sum.
struct QualityTally {
  std::int64_t squared_lengths = 0, squared_sizes = 0, excess = 0, triangles = 0;
  double largest_excess = 0;

  void add(const QualityTally& other) {
    squared_lengths += other.squared_lengths;
    squared_sizes += other.squared_sizes;
    excess += other.excess;
    triangles += other.triangles;
    largest_excess = largest_excess < other.largest_excess ? other.largest_excess : largest_excess;
  }
};

/// Largest number of sites in one call of QualityKernel. With at most this number, sums stay within 64 bits and the
/// list of excesses fits into the cache.
constexpr LocalIndex most_measured = 1024;

/// @brief Measures the triangles at the local sites of [begin, end), which are at most `most_measured` sites. A
/// triangle is counted at the lexicographically smallest of its corners. Cost: about 15 ns per site.
/// @param inverse_reference 1 / h_ref, where h_ref is the typical size that SweepSums uses
/// @param excesses receives alpha - 1 of each triangle; has room for 8 per site
using QualityKernel = QualityTally (*)(const SweepTask& task, LocalIndex begin, LocalIndex end,
                                       double inverse_reference, double* excesses);

/// The three kernels, compiled for one kind of processor.
struct SweepKernels {
  SweepKernel sweep;
  CertifyKernel certify;
  QualityKernel measure;
};
extern const SweepKernels kernels_portable, kernels_avx2, kernels_avx512;
/// Returns the kernels for the processor of this machine, as simd_level() finds it.
inline const SweepKernels& sweep_kernels() {
  return *of_level(simd_level(), &kernels_portable, &kernels_avx2, &kernels_avx512);
}

} // namespace trime::sweep
