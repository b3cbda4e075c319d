// SPDX-License-Identifier: BSD-3-Clause
// Thins curves that turn back and forth over distances far below the resolution, or that have far too many vertices for
// it.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>

namespace trime::generalise {

/// Options of the thinning.
enum class Thinning : char {
  once,
  to_the_end, ///< thins loops with far too many vertices until nothing changes, and others once
  dense       ///< thins loops with far too many vertices until nothing changes, and others not at all
};

/// @brief Returns the boundary with straight pieces in place of ragged runs of straight pieces, and of smooth runs with
/// vertices that are even closer together. A run is ragged if it turns by more than GeneraliseRules::ragged_turn over a
/// distance of `share` h. A vertex stays where it is or is removed. A removed vertex lies within about share h of a
/// vertex that stays, or within a few times that if thinned to the end. The sharpest turns stay. Curves may cross
/// afterwards; the caller must check. Returns null if nothing is ragged. O(pieces log(pieces))
std::unique_ptr<geometry::Boundary> without_ragged_runs(const geometry::Boundary& boundary,
                                                        const sizing::SizeField& size, double share,
                                                        Thinning thinning = Thinning::once);

} // namespace trime::generalise
