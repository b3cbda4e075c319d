// SPDX-License-Identifier: BSD-3-Clause
// Finds the triangle on the left of each labelled edge, and the points on the edges of each label. Formats with
// surfaces and sets of points need both.
#pragma once

#include "formats/exchange_mesh.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace trime::formats {

/// A side of a triangle. Side 1 joins the first and the second corner, side 2 the second and the third, side 3 the
/// third and the first.
struct EdgeSide {
  GlobalId element;
  std::int64_t side;
};

/// @brief Returns for each labelled edge of this rank the side of the triangle on its left. On the left of a boundary
/// edge lies the mesh, on the left of an interface the region with the lower number. Cost: O(triangles of this rank);
/// memory: about 32 bytes for each side whose ends have labels or belong to other ranks.
/// @param element returns the number of a triangle of this rank in the file; it gets the row
/// @throws FileError on all ranks if an edge is not a side of a triangle
/// @note Collective.
std::vector<EdgeSide> left_sides(const ExchangeMesh& mesh, const std::function<GlobalId(std::int64_t row)>& element);

/// A point on an edge with a label.
struct LabelledPoint {
  GlobalId point;
  std::int64_t label;
  auto operator<=>(const LabelledPoint&) const = default;
};

/// @brief Returns a share of all points on labelled edges: each point once for each label of its edges, ascending over
/// the ranks. The order does not depend on the number of ranks.
/// @note Collective.
std::vector<LabelledPoint> labelled_points(const ExchangeMesh& mesh);

} // namespace trime::formats
