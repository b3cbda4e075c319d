// SPDX-License-Identifier: BSD-3-Clause
// Reads the rings of contour files: lines 'x y', maps, segments of Triangle's .poly.
#pragma once

#include "curve.hpp"

#include <string>
#include <vector>

namespace trime_check {

struct ContourRings {
  std::vector<Ring> rings;
  std::string reason;            ///< why no ring was read; empty: all are here
  std::string crs;               ///< name of the reference system in a map; empty: the map has none
  std::vector<int> polygon = {}; ///< number of the polygon of each ring in a map; 0 for lines; empty for other files
};

/// Says whether lines of a map that do not close a ring make the map unreadable, or are ignored.
enum class OpenLines { refuse, leave_out };

/// Reads a contour file by its ending. Rings are as the file has them, without the repeated first vertex.
ContourRings read_contour(const std::string& path, OpenLines lines);

} // namespace trime_check
