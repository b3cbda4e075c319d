// SPDX-License-Identifier: BSD-3-Clause
// First layout of the boundary sites of one loop: corners, shells at sharp corners, quantiles of the integral of ds/h.
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

/// A site of one loop, given by its place along the loop. Ranks send it to each other, so no byte is left undefined.
struct LoopSite {
  double t;                ///< coordinate of LoopMetric, in [0, total)
  geometry::Vec2 position; ///< on the unrolled loop
  SiteKind kind;
  std::int32_t loop = 0; ///< whose number the metric does not know
};

/// The role as a site of a junction of two pieces, at the start of one of them.
SiteKind kind_of_junction(const geometry::Loop& loop, std::size_t piece, double corner_angle);

/// @brief The stretches of a loop between its corners, and the sites that belong on them. Ranks may lay out shares of a
/// loop: together they are the same as all of it. Keeps references. All threads work.
class LoopLayout {
public:
  LoopLayout(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle,
             const FeatureTolerance& tolerance);
  LoopLayout(LoopLayout&&) noexcept;
  ~LoopLayout();

  /// About what all sites cost to make; that of a plain one is 1.
  std::int64_t work() const;
  /// Appends the sites that begin in [first, last) of that work, in order along the loop from some place on.
  /// @throws GeometryError if the size is too small for the lattice
  void make(std::int64_t first, std::int64_t last, std::vector<LoopSite>& sites) const;

private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

/// All sites of a loop, by rising t. There are at least 3.
void sort_along(std::span<LoopSite> sites);

} // namespace trime::boundary
