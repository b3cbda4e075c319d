// SPDX-License-Identifier: BSD-3-Clause
// Makes rings: of vertices in reading order, whatever format they come from, and of numbered vertices and the segments
// between them, as files of meshing programs have them.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/vec2.hpp"

#include <string>
#include <vector>

namespace trime::contours {

/// Makes the rings of a contour. Removes repeated vertices and refuses rings that are too short.
class RingBuilder {
public:
  /// @param contour names its source; receives rings and warnings, and outlives this object
  explicit RingBuilder(Contour& contour) : contour_(contour) {}

  /// Sets what later messages say behind the line, such as " (feature 3)".
  void set_feature(const std::string& feature) { feature_ = feature; }
  /// @param marker of the edge from this vertex to the next
  /// @throws GeometryError for coordinates that are too large
  void add(geometry::Vec2 p, int line, int marker = 0);
  /// @throws GeometryError for a ring with fewer than three distinct vertices
  void end_ring();
  /// @param expected what the text should contain, for the message if it has no vertex
  /// @throws GeometryError
  void finish(const char* expected);

private:
  int distinct_vertices() const;
  void warn(geometry::Vec2 p, int line);

  Contour& contour_;
  ContourRing ring_;
  std::string feature_;
  int merged_ = 0;
};

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
