// SPDX-License-Identifier: BSD-3-Clause
// Checks that the mesh covers the shape of a config, and nothing else.
#pragma once

#include "report.hpp"
#include "shape.hpp"

#include <optional>

namespace trime_check {

/// A loop of the shape that simplification changed. All of it lies within half of its length from `place`.
struct ChangedLoop {
  Point place;
  double length = 0;
};

/// Lists the changes that the simplification made to the shape before meshing.
struct Changes {
  bool are_known = true; ///< false if the file is an intermediate step of a run, which does not store the changes
  std::vector<ChangedLoop> loops;
  double stray = 0; ///< [h asked for] largest distance of the boundary of the mesh from the curves of the shape
};

/// @brief Finds triangles outside the shape, curves of the shape without facets, and places inside the shape without a
/// triangle. Cost: O(n log n) for n triangles, facets and vertices of curves.
/// @pre all parts of the region have curves
void check_cover(const Shape& shape, const Mesh& mesh, const Changes& changes, Report& report);

} // namespace trime_check
