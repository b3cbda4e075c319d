// SPDX-License-Identifier: BSD-3-Clause
// One pass over the sites of a tile that certifies their stars at the present positions and moves them: several sites
// side by side, the same bits for any number of them.
#pragma once

#include "core/simd_level.hpp"
#include "polygon/guard_cells.hpp"
#include "sweep/rule_formulas.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <cstdint>

namespace trime::sweep {

/// How the pass treats a site.
enum class SiteClass : std::uint8_t {
  held,     ///< stays, and has no star: a boundary site
  fixed,    ///< stays, but has a star, which is certified by emptiness: a point that the user has fixed
  exact,    ///< moves; its star is certified by emptiness, since not all neighbours have stars that this rank keeps
  bordered, ///< moves; next to chords of the boundary, as `local` while no site is in the disc of a chord nearby
  local     ///< moves; its star is certified by the stars around it
};

/// Bits that say what a pass has to do with a site. One without `awake` and `watched` is asleep.
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
  const SiteClass* classes;                 ///< of owned sites
  const std::int32_t* boundary = nullptr;   ///< of all sites, see BinnedPoints::boundary; for QualityKernel only
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

/// Sums over the moves of some sites, in integers, so that they may be added in any order.
struct SweepTally {
  std::int64_t moving = 0; ///< moved by more than SweepRules::still
  std::int64_t power = 0;  ///< of the moves, in units of FixedSum, see Momentum
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

  /// @param x, y from the old place to the new one @param lead_x, lead_y old lead, and new
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

/// Does a site that the rule would move so rest whatever its momentum? Then it need not be looked at again before it, a
/// neighbour, its star or the rule changes.
template <class V>
TRIME_INLINE auto surely_rests(V move_x, V move_y, V h) {
  static_assert((1 + SweepRules::largest_momentum) * SweepRules::rest_share < 1);
  const V limit = (SweepRules::rest_share * SweepRules::rest) * h;
  return move_x * move_x + move_y * move_y < limit * limit;
}

/// Sites that the pass leaves to its caller, each list ascending with any number of lanes. The caller makes room for
/// all of them.
struct SweepLeftovers {
  LocalIndex* suspects;  ///< whose stars must be certified by emptiness before they move
  LocalIndex* irregular; ///< with good stars, but with a move above the cap, which is not made
  LocalIndex* guarded;   ///< moved to a place near the boundary, where they may have to be pushed
  std::ptrdiff_t suspect_count = 0, irregular_count = 0, guarded_count = 0;
  std::ptrdiff_t awake_count = 0; ///< how many sites were awake
};

/// @brief Certifies the local sites of [begin, end) by the Delaunay lemma (a triangulation is Delaunay if every star
/// winds once, counter-clockwise, and is locally convex: Delaunay 1934) and computes their next positions and leads.
/// Sites that it does not move keep their place. Sites that surely rest fall asleep. Takes about 10 ns per site, and
/// more for the rule; less than 1 ns for a site that sleeps among others.
/// @pre the rings of all local sites and their neighbours agree with each other
/// @return tally of the sites that it moved
using SweepKernel = SweepTally (*)(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers);

/// @brief Certifies the same stars and moves nothing: receives the sites whose stars must be certified by emptiness,
/// ascending, with room for all of them. Needs no rule, leads and next places. About 10 ns a site.
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

/// Most sites of one call of QualityKernel: keeps its sums within 64 bits, and the list of excesses in the cache.
constexpr LocalIndex most_measured = 1024;

/// @brief Measures the stars of the local sites of [begin, end), at most `most_measured`. A triangle counts at the
/// lexicographically smallest of its corners. About 15 ns a site.
/// @param inverse_reference 1 / h_ref of SweepSums
/// @param excesses receives alpha - 1 of each triangle; room for 8 a site
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
