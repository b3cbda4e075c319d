// SPDX-License-Identifier: BSD-3-Clause
// Places the first sites on one loop of the boundary: at corners, at equal distances around sharp corners (shells), and
// in between at equal shares of the integral of ds/h.
#pragma once

#include "boundary/loop_metric.hpp"
#include "boundary/site_places.hpp"

#include "trime/geometry/lattice.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace trime::boundary {

enum class SiteKind : std::int32_t { plain, corner, sharp_corner };

/// A site of one loop. Ranks exchange it as bytes, so it has no padding.
struct LoopSite {
  double t;                ///< coordinate along the loop in units of h, see LoopMetric; in [0, total)
  geometry::Vec2 position; ///< position on the loop as a continuous curve, which may leave a periodic container
  SiteKind kind;
  std::int32_t loop = 0; ///< number of the loop in the boundary
};

/// Returns whether the start of `piece`, where two pieces of the loop meet, is a plain site, a corner or a sharp
/// corner.
SiteKind kind_of_junction(const geometry::Loop& loop, std::size_t piece, double corner_angle);

/// @brief Cuts a loop into stretches between its corners, and places sites on them. Ranks may each do a share of a
/// loop; together the shares give all of its sites. Keeps references to its arguments. Uses all threads.
class LoopLayout {
public:
  LoopLayout(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle,
             const FeatureTolerance& tolerance);
  LoopLayout(LoopLayout&&) noexcept;
  ~LoopLayout();

  /// Returns the estimated work of placing all sites, where a plain site counts as 1.
  std::int64_t work() const;
  /// Appends the sites that begin in the share [first, last) of the work, in their order along the loop.
  /// @throws GeometryError if the size is too small for the coordinate lattice
  void make(std::int64_t first, std::int64_t last, std::vector<LoopSite>& sites) const;

private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

/// Sorts all sites of a loop by ascending t.
/// @pre there are at least 3 sites
void sort_along(std::span<LoopSite> sites);

} // namespace trime::boundary
