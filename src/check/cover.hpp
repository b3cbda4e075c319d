// SPDX-License-Identifier: BSD-3-Clause
// Is the mesh all of the shape of a config, and nothing else?
#pragma once

#include "report.hpp"
#include "shape.hpp"

#include <optional>

namespace trime_check {

/// A loop of the shape that is not bit for bit as it was given: all of it lies within half its length of a place.
struct ChangedLoop {
  Point place;
  double length = 0;
};

/// How the shape was simplified before it was meshed.
struct Changes {
  bool are_known = true; ///< false: the file is a step of a run, which does not say
  std::vector<ChangedLoop> loops;
  double stray = 0; ///< [h asked for] how far the boundary may lie from the curves, chords included
};

/// @brief Triangles outside of the shape, curves around it without facets, places of it without a triangle.
/// n log n in triangles, facets and vertices of curves.
/// @pre all parts of the region have curves
void check_cover(const Shape& shape, const Mesh& mesh, const Changes& changes, Report& report);

} // namespace trime_check
