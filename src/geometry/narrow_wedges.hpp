// SPDX-License-Identifier: BSD-3-Clause
// Finds regions that end in a thin tip between two interfaces.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <array>
#include <cstddef>
#include <set>
#include <vector>

namespace trime::geometry {

/// One end of an arc.
struct ArcEnd {
  std::size_t arc;
  bool at_end; ///< whether the arc ends here; otherwise it begins here
};

/// @brief A region that ends at a node, between two interfaces that meet there at less than 20 degrees. Both begin with
/// straight pieces, and neither lies on a curve.
struct NarrowWedge {
  Vec2 node;
  ArcEnd right, left;            ///< seen from the node, the region lies on the left of `right`
  int region = 0;                ///< the one that ends here
  int right_region, left_region; ///< regions beyond the two arcs
  auto key() const {
    return std::array<double, 5>{node.x, node.y, double(region), double(right_region), double(left_region)};
  }
};

/// Returns the narrow wedges at all nodes, in the order of the nodes. Cost: O(n log n).
std::vector<NarrowWedge> narrow_wedges(const std::vector<InnerArc>& arcs, const Boundary& boundary);

} // namespace trime::geometry
