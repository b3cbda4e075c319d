// SPDX-License-Identifier: BSD-3-Clause
// Reads the rings of contour files: lines 'x y', polygons of GeoJSON, segments of Triangle's .poly.
#pragma once

#include "curve.hpp"

#include <string>
#include <vector>

namespace trime_check {

struct ContourRings {
  std::vector<Ring> rings;
  std::string reason; ///< why no ring was read; empty: all are here
};

/// Reads a contour file by its ending. Rings are as the file has them, without the repeated first vertex.
ContourRings read_contour(const std::string& path);

} // namespace trime_check
