// SPDX-License-Identifier: BSD-3-Clause
// Cuts the tips of regions that end between two interfaces, where they are thinner than the triangles.
#pragma once

#include "geometry/narrow_wedges.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>

namespace trime::generalise {

/// Holds the input of the simplification of arcs.
struct ArcRequest {
  const sizing::SizeField& size;
  const geometry::Lattice& lattice;
  std::span<const geometry::Vec2> kept;   ///< vertices that stay, and nodes whose wedges stay, in lexicographic order
  std::span<const geometry::Vec2> tips{}; ///< nodes at which absorb_parts() leaves narrow ends, in the same order
};

/// @brief Cuts narrow wedges where they become as wide as GeneraliseRules::narrow_inside. The tip belongs to the region
/// beyond the longer of its two sides; if both are equally long, to the one with the lower number. The two regions
/// next to the tip touch along the other side, up to a new node. The end of the wedge is slanted, so that triangles of
/// size h fit into it. A wedge stays as it is if its sides are not straight up to one h behind the cut, or if another
/// curve lies in the tip. So no region is cut to pieces, and none vanishes. Adds to InnerCurves::losses. Does not set
/// InnerArc::start_wedge and end_wedge. Cost: O(n log n).
/// @param given the narrow wedges before simplification; others stay as they are
/// @throws GeometryError if a size is not positive and finite
void cut_wedges(geometry::InnerCurves& curves, std::span<const geometry::NarrowWedge> given,
                const geometry::Boundary& boundary, const ArcRequest& request);

} // namespace trime::generalise
