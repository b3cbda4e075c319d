// SPDX-License-Identifier: BSD-3-Clause
// Checks that the mesh covers the shape of a config, and nothing else.
#pragma once

#include "report.hpp"
#include "shape.hpp"

#include <optional>

namespace trime_check {

/// A loop of the shape that was changed. All of it lies within half of its length from a place.
struct ChangedLoop {
  Point place;
  double length = 0;
};

/// How the shape was simplified before it was meshed.
struct Changes {
  bool are_known = true; ///< false if the file is a step of a run, which does not store the changes
  std::vector<ChangedLoop> loops;
  double stray = 0; ///< [h asked for] largest distance of the boundary, chords included, from the curves
};

/// @brief Finds triangles outside the shape, curves around it without facets, and places in it without a triangle. O(n
/// log n) for n triangles, facets and vertices of curves.
/// @pre all parts of the region have curves
void check_cover(const Shape& shape, const Mesh& mesh, const Changes& changes, Report& report);

} // namespace trime_check
