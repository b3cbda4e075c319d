// SPDX-License-Identifier: BSD-3-Clause
// Removes vertices from curves that turn back and forth over distances far below the resolution of the mesh, or that
// have far more vertices than the mesh needs.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <span>

namespace trime::generalise {

/// Options for removing vertices of curves.
struct Thinning {
  double share; ///< [h] vertices nearer to each other than this may be removed
  enum Extent : char {
    once,
    to_the_end, ///< loops with far too many vertices until nothing changes, and other loops once
    dense       ///< loops with far too many vertices until nothing changes, and no other loops
  } extent = once;
};

/// @brief Returns the boundary with fewer vertices in ragged sequences of straight pieces, and in smooth sequences
/// whose vertices are even closer together. A sequence is ragged if it turns by more than GeneraliseRules::ragged_turn
/// over a distance of `share` h. A vertex either stays in place or is removed. A removed vertex lies within about
/// `share` h of a vertex that stays, or within a few times that distance if the loop is thinned until nothing changes.
/// The sharpest turns stay. If the curves were simple, they stay simple, and all nodes on them and all points `inside`
/// stay on their side: a vertex stays if any of these lies in the triangle of the vertex and its neighbours
/// (vertex_tree.hpp). Returns null if no vertex is removed. Cost: O(pieces log(pieces)).
/// @param inside points of the coordinate lattice
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<geometry::Boundary> without_ragged_runs(const geometry::Boundary& boundary,
                                                        const sizing::SizeField& size, const geometry::Lattice& lattice,
                                                        std::span<const geometry::Vec2> inside, Thinning thinning);

} // namespace trime::generalise
