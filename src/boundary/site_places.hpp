// SPDX-License-Identifier: BSD-3-Clause
// Makes the places of a stretch of a loop from which its sites are chosen.
#pragma once

#include "boundary/loop_metric.hpp"
#include "boundary/site_path.hpp"

#include "trime/geometry/lattice.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace trime::boundary {

/// The largest allowed distance from a chord to the boundary: `share` times the local size that the user asked for.
struct FeatureTolerance {
  double share; ///< 0 if every corner is kept
  /// Upper bound on this distance, as a length, for sizes far larger than the shape.
  double most = std::numeric_limits<double>::infinity();

  double at(double asked_size) const { return std::fmin(most, share * asked_size); }
};

/// @brief Returns both ends, the junctions between t0 and t1, and places in between that are at most a quarter of the
/// local size apart. A junction is a place where two pieces of the boundary meet. Junctions between two kept ones are
/// left out if their distance to the chord between these two is at most BoundaryRules::place_thinning times the
/// tolerance (Douglas and Peucker 1973). Cost: O(n log n) for n junctions, at most O(64 n).
std::vector<SitePlace> places_between(const LoopMetric& metric, double t0, double t1, const geometry::Lattice& lattice,
                                      const FeatureTolerance& tolerance);

} // namespace trime::boundary
