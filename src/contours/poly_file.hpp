// SPDX-License-Identifier: BSD-3-Clause
// Reads the .poly files of Triangle (Shewchuk, https://www.cs.cmu.edu/~quake/triangle.poly.html).
#pragma once

#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// A region point: the face of the segments around it has the attribute.
struct RegionPoint {
  FilePoint at;
  double attribute = 0;
  double largest_area = 0; ///< largest area of a triangle in the face; 0 or less: no limit
};

/// Holds what a file contains.
struct PolyFile {
  std::vector<FileVertex> vertices;
  std::vector<FileSegment> segments;
  std::vector<FilePoint> holes;
  std::vector<RegionPoint> regions;
};

/// @param nodes text of the `.node` file; needed if the `.poly` file has no vertices
/// @throws GeometryError `source:line: ...` for a text that is not in the `.poly` format
PolyFile read_poly_file(std::string_view text, const std::string& source, std::string_view nodes);

} // namespace trime::contours
