// SPDX-License-Identifier: BSD-3-Clause
// Rings out of numbered vertices and the segments between them, as files of meshing programs have them.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <string>
#include <vector>

namespace trime::contours {

struct FileVertex {
  geometry::Vec2 position;
  int line;   ///< in the file
  int number; ///< that the file gives it
};
/// Between two vertices, by their places in the list.
struct FileSegment {
  int from, to;
  int marker;
  int line;
};

/// A vertex of a ring, and the marker of the segment that leaves it.
struct RingVertex {
  geometry::Vec2 position;
  int line;
  int marker;
};

/// @brief Rings, each without a vertex that it visits twice; where rings meet in a vertex they stay apart. Vertices at
/// one place are one. Segments without length, or given before, are left out with a warning. O(n log n)
/// @throws GeometryError `source:line: ...` where a number of segments that is odd meets
std::vector<std::vector<RingVertex>> rings_of_segments(const std::vector<FileVertex>& vertices,
                                                       std::vector<FileSegment> segments, const std::string& source,
                                                       std::vector<std::string>& warnings);

} // namespace trime::contours
