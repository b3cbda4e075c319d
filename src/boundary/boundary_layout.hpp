// SPDX-License-Identifier: BSD-3-Clause
// Makes the first layout of the boundary sites of one loop: corners, shells at sharp corners, and quantiles of the
// integral of ds/h.
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

/// A site of one loop, given by its place along the loop. Ranks exchange it, so all bytes are defined.
struct LoopSite {
  double t;                ///< coordinate of LoopMetric, in [0, total)
  geometry::Vec2 position; ///< on the unrolled loop
  SiteKind kind;
  std::int32_t loop = 0; ///< number of the loop, which the metric does not know
};

/// Returns the role of a site at a junction of two pieces, which is the start of `piece`.
SiteKind kind_of_junction(const geometry::Loop& loop, std::size_t piece, double corner_angle);

/// @brief Holds the stretches of a loop between its corners, and makes the sites on them. Ranks may lay out shares of a
/// loop, which together give all of its sites. Keeps references. Uses all threads.
class LoopLayout {
public:
  LoopLayout(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle,
             const FeatureTolerance& tolerance);
  LoopLayout(LoopLayout&&) noexcept;
  ~LoopLayout();

  /// Returns about the work of making all sites, where a plain site has the work 1.
  std::int64_t work() const;
  /// Appends the sites that begin in [first, last) of that work, in their order along the loop.
  /// @throws GeometryError if the size is too small for the lattice
  void make(std::int64_t first, std::int64_t last, std::vector<LoopSite>& sites) const;

private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

/// Sorts all sites of a loop by rising t. @pre there are at least 3
void sort_along(std::span<LoopSite> sites);

} // namespace trime::boundary
