// SPDX-License-Identifier: BSD-3-Clause
// Lists the pairs of points on the two sides of split curves, in the order of the curves.
#pragma once

#include "splitting/split_edges.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace trime::splitting {

/// The two sides of a split edge: ids of its ends in the split mesh, in the direction of the curve.
struct EdgeSides {
  std::array<GlobalId, 2> left, right;

  /// Returns whether the edge has become two. An edge between two single ends stays one.
  bool are_apart() const { return left != right; }
};

/// A pair of points with equal coordinates.
struct SplitPair {
  std::array<GlobalId, 2> points; ///< on the left and on the right of the curve
  std::int32_t curve, path;
};

/// @brief Lists the pairs along each path: a longest sequence of edges of one curve where each edge goes on from both
/// copies with which the edge before it ends. A path ends where the curve ends, meets the boundary, or where other
/// split edges meet it. Single ends are left out. A ring has each pair once. Paths are ordered by curve, then by their
/// first edge in the list; a ring begins with its first edge in the list. Cost: O(edges log edges).
/// @param sides of each edge, in the same order
std::vector<SplitPair> split_pairs(const std::vector<SplitEdge>& edges, const std::vector<EdgeSides>& sides);

} // namespace trime::splitting
