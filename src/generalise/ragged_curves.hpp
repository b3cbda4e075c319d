// SPDX-License-Identifier: BSD-3-Clause
// Curves that turn to and fro on ways far below the resolution, or have far more vertices than it needs.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>

namespace trime::generalise {

/// How curves are thinned.
enum class Thinning : char {
  once,
  to_the_end, ///< loops with far too many vertices until none goes any more, others once
  dense       ///< the same, and others not at all
};

/// @brief The boundary with straight pieces in place of runs of straight pieces that are ragged: that turn by more
/// than GeneraliseRules::ragged_turn on a way of `share` h; and of smooth runs whose vertices are far closer to each
/// other still. Vertices stay where they are or go; what goes lies within
/// about share h of a vertex that stays, or within a few times that if thinned to the end. The sharpest turns stay.
/// Curves may come to cross: the caller finds out. Null if there is nothing ragged. O(pieces log(pieces))
std::unique_ptr<geometry::Boundary> without_ragged_runs(const geometry::Boundary& boundary,
                                                        const sizing::SizeField& size, double share,
                                                        Thinning thinning = Thinning::once);

} // namespace trime::generalise
