// SPDX-License-Identifier: BSD-3-Clause
// Makes rings from numbered vertices and the segments between them, which files of meshing programs contain.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <string>
#include <vector>

namespace trime::contours {

struct FileVertex {
  geometry::Vec2 position;
  int line;   ///< line in the file
  int number; ///< number in the file
};
/// A segment between two vertices, by their indices in the list.
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

/// @brief Joins segments into rings. No ring visits a vertex twice; rings that meet in a vertex stay separate. Vertices
/// at one place are one vertex. Segments without length and repeated segments are left out with a warning. O(n log n)
/// @throws GeometryError `source:line: ...` where an odd number of segments meets
std::vector<std::vector<RingVertex>> rings_of_segments(const std::vector<FileVertex>& vertices,
                                                       std::vector<FileSegment> segments, const std::string& source,
                                                       std::vector<std::string>& warnings);

} // namespace trime::contours
