// SPDX-License-Identifier: BSD-3-Clause
// Thins curves that turn back and forth over distances far below the resolution, or that have far too many vertices for
// it.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <span>

namespace trime::generalise {

/// Says how curves are thinned.
struct Thinning {
  double share; ///< [h] vertices nearer to each other may go
  enum Extent : char {
    once,
    to_the_end, ///< loops with far too many vertices until nothing changes, and others once
    dense       ///< the same, and others not at all
  } extent = once;
};

/// @brief Returns the boundary with straight pieces in place of ragged runs of straight pieces, and of smooth runs with
/// vertices that are even closer together. A run is ragged if it turns by more than GeneraliseRules::ragged_turn over a
/// distance of `share` h. A vertex stays where it is or is removed. A removed vertex lies within about share h of a
/// vertex that stays, or within a few times that if thinned to the end. The sharpest turns stay. If the curves were
/// simple, they stay simple, and all nodes on them and all `inside` stay on their side: a vertex stays if any of these
/// lies in the triangle with its neighbours (vertex_tree.hpp). Null if nothing goes. O(pieces log(pieces))
/// @param inside lattice points @throws GeometryError if a size is not positive and finite
std::unique_ptr<geometry::Boundary> without_ragged_runs(const geometry::Boundary& boundary,
                                                        const sizing::SizeField& size, const geometry::Lattice& lattice,
                                                        std::span<const geometry::Vec2> inside, Thinning thinning);

} // namespace trime::generalise
