// SPDX-License-Identifier: BSD-3-Clause
// The kernels of a sweep: one pass over the sites of a tile certifies their stars at the present positions and moves
// them. A kernel processes several sites at once; the bits do not depend on how many.
#pragma once

#include "core/simd_level.hpp"
#include "polygon/disc_cells.hpp"
#include "sweep/rule_formulas.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <cstdint>

namespace trime::sweep {

/// How the pass treats a site.
enum class SiteClass : std::uint8_t {
  held,     ///< a boundary site: it does not move and has no star
  fixed,    ///< a fixed point of the user: it does not move; its star needs the empty-circumcircle test
  exact,    ///< moves; its star needs the empty-circumcircle test, because this rank does not keep the stars of all its
            ///< neighbours
  bordered, ///< moves, next to chords of the boundary; treated as `local` while no site is in the disc of a chord
            ///< nearby
  local     ///< moves; its star is certified by the stars around it
};

/// Bits that say what a pass must do with a site. A site without `awake` and `watched` is asleep.
struct SiteFlags {
  static constexpr std::uint8_t awake = 1;   ///< the rule may move it
  static constexpr std::uint8_t watched = 2; ///< its star is certified even if nothing has moved: not local, or the
                                             // /< lemma did not do for it
  static constexpr std::uint8_t copied = 4;  ///< asleep, with the same place and no lead both now and next
  TRIME_INLINE static constexpr bool is_asleep(std::uint8_t flags) { return (flags & (awake | watched)) == 0; }
};

/// The input and output of a kernel: plain arrays by local index, and values that are the same for all sites.
struct SweepTask {
  const geometry::Vec2* positions;
  const geometry::Vec2* leads; ///< null, like next_leads, where sites have none: then all are zero
  const LocalIndex* rings;     ///< 8 slots each, a shorter ring is repeated in them
  const std::uint8_t* degrees;
  const SiteClass* classes;                 ///< class of each owned site
  const std::int32_t* boundary = nullptr;   ///< see BinnedPoints::boundary; only for QualityKernel
  SiteClass least_class = SiteClass::local; ///< sites of a lower class are left to the caller
  std::uint8_t* flags = nullptr;            ///< SiteFlags; of use to SweepKernel only. Held sites are asleep, and those
                                            // /< of all other classes but `local` are watched
  const double* sizes = nullptr;            ///< null: uniform_size everywhere
  double uniform_size = 1;
  geometry::Vec2* next_positions;
  geometry::Vec2* next_leads;

  RuleParameters rule;
  double lattice_step = 1, inverse_lattice_step = 1;
  geometry::Box box;                      ///< no site leaves it; infinite along periodic axes
  double cap_factor = 1, largest_cap = 1; ///< as in StarBuilder::cap

  polygon::GuardCells guard;
};

/// Sums over the moves of some sites. They are integers, so they may be added in any order.
struct SweepTally {
  std::int64_t moving = 0; ///< sites that moved by more than SweepRules::still
  std::int64_t power = 0;  ///< power of the moves in units of FixedSum, see Momentum
  std::int64_t pushed = 0, deleted = 0;
  double squared_ratio = 0;    ///< largest squared move over h^2
  double squared_distance = 0; ///< largest squared move

  void add(const SweepTally& other) {
    moving += other.moving;
    power += other.power;
    pushed += other.pushed;
    deleted += other.deleted;
    squared_ratio = squared_ratio < other.squared_ratio ? other.squared_ratio : squared_ratio;
    squared_distance = squared_distance < other.squared_distance ? other.squared_distance : squared_distance;
  }
};

/// Adds one site to the tally; the vector path computes the same bits.
template <class V>
struct SiteTally {
  V squared_distance, squared_ratio, power;

  /// @param x, y move from the old place to the new one @param lead_x, lead_y old lead; next_lead_x, next_lead_y new
  /// lead
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

/// Returns whether a site with this move rests for any momentum. Then it need not be examined again until it, a
/// neighbour, its star or the rule changes.
template <class V>
TRIME_INLINE auto surely_rests(V move_x, V move_y, V h) {
  static_assert((1 + SweepRules::largest_momentum) * SweepRules::rest_share < 1);
  const V limit = (SweepRules::rest_share * SweepRules::rest) * h;
  return move_x * move_x + move_y * move_y < limit * limit;
}

/// Sites that the pass leaves to its caller. Each list is ascending, for any number of lanes. The caller provides room
/// for all sites.
struct SweepLeftovers {
  LocalIndex* suspects;  ///< sites whose stars need the empty-circumcircle test before they move
  LocalIndex* irregular; ///< sites with good stars whose move exceeds the cap and was not made
  LocalIndex* guarded;   ///< sites that moved to a place near the boundary and may have to be pushed
  std::ptrdiff_t suspect_count = 0, irregular_count = 0, guarded_count = 0;
  std::ptrdiff_t awake_count = 0; ///< how many sites were awake
};

/// @brief Certifies the local sites of [begin, end) by the Delaunay lemma (a triangulation is Delaunay if every star
/// winds once, counter-clockwise, and is locally convex: Delaunay 1934) and computes their next positions and leads.
/// Sites that it does not move keep their place. Sites that surely rest fall asleep. Takes about 10 ns per site in
/// addition to the rule, and less than 1 ns for a site that sleeps among others.
/// @pre the rings of all local sites and their neighbours agree with each other
/// @return the sums over the sites that it moved
using SweepKernel = SweepTally (*)(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers);

/// @brief Certifies the same stars without moving sites. `suspects` receives the sites whose stars need the
/// empty-circumcircle test, in ascending order, and must have room for all sites. Needs no rule, leads or next places.
/// Takes about 10 ns per site.
/// @return number of these sites
using CertifyKernel = std::ptrdiff_t (*)(const SweepTask& task, LocalIndex begin, LocalIndex end, LocalIndex* suspects);

/// Sums over the stars of some sites, in units of FixedSum; see SweepSums.
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

/// Largest number of sites in one call of QualityKernel. It keeps the sums within 64 bits, and the list of excesses in
/// the cache.
constexpr LocalIndex most_measured = 1024;

/// @brief Measures the stars of the local sites of [begin, end), at most `most_measured`. A triangle counts at the
/// lexicographically smallest of its corners. Takes about 15 ns per site.
/// @param inverse_reference 1 / h_ref of SweepSums
/// @param excesses receives alpha - 1 of each triangle; has room for 8 per site
using QualityKernel = QualityTally (*)(const SweepTask& task, LocalIndex begin, LocalIndex end,
                                       double inverse_reference, double* excesses);

/// The kernels for one kind of processor.
struct SweepKernels {
  SweepKernel sweep;
  CertifyKernel certify;
  QualityKernel measure;
};
extern const SweepKernels kernels_portable, kernels_avx2, kernels_avx512;
/// Returns the kernels for this machine, see simd_level().
inline const SweepKernels& sweep_kernels() {
  return *of_level(simd_level(), &kernels_portable, &kernels_avx2, &kernels_avx512);
}

} // namespace trime::sweep
