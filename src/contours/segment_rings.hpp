// SPDX-License-Identifier: BSD-3-Clause
// Makes rings from vertices in reading order, and from numbered vertices and segments between them, as files of meshing
// programs have them.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/vec2.hpp"

#include <string>
#include <vector>

namespace trime::contours {

/// Makes the rings of a contour vertex by vertex. Removes repeated vertices; rings with too few vertices are faults.
class RingBuilder {
public:
  /// @param contour its member `source` must be set; receives rings and warnings, and must outlive this object
  explicit RingBuilder(Contour& contour) : contour_(contour) {}

  /// Sets a text that later messages contain after the line number, such as " (feature 3)".
  void set_feature(const std::string& feature) { feature_ = feature; }
  /// Sets the polygon to which the next rings belong, see ContourRing::polygon.
  void set_polygon(int polygon) { polygon_ = polygon; }
  /// Adds a vertex to the current ring.
  /// @param marker marker of the edge from this vertex to the next
  /// @throws GeometryError for coordinates that are too large
  void add(geometry::Vec2 p, int line, int marker = 0);
  /// Leaves out the current ring, which has a vertex that cannot be read.
  void spoil() { is_spoiled_ = true; }
  /// Ends the current ring. A ring with fewer than three distinct vertices becomes a fault of the contour.
  void end_ring();
  /// Ends the last ring and the text.
  void finish();
  /// Warns of a vertex that repeats the one before, if it is one of the first.
  void tell_merged(geometry::Vec2 p, int line);

private:
  int distinct_vertices() const;

  Contour& contour_;
  ContourRing ring_;
  std::string feature_;
  int polygon_ = 0;
  int merged_ = 0;
  bool is_spoiled_ = false;
};

struct FileVertex {
  geometry::Vec2 position;
  int line;   ///< line of the vertex in the file
  int number; ///< number of the vertex in the file
};
/// A segment between two vertices, given by their indices in the list of vertices.
struct FileSegment {
  int from, to;
  int marker;
  int line;
};

/// A vertex of a ring, with the marker of the segment that begins there.
struct RingVertex {
  geometry::Vec2 position;
  int line;
  int marker;
};

/// @brief Removes open chains: segments that end where no other segment does, again and again. Vertices with the same
/// coordinates count as one vertex. A warning names how many there are, and the place of the first one in the file.
/// Removes nothing if nothing would be left. Cost: O(n log n).
void remove_open_chains(const std::vector<FileVertex>& vertices, std::vector<FileSegment>& segments,
                        const std::string& source, std::vector<std::string>& warnings);

/// @brief Joins segments into rings. No ring visits a vertex twice; rings that meet at a vertex stay separate. Vertices
/// with the same coordinates count as one vertex. Segments without length and repeated segments are left out with a
/// warning. Cost: O(n log n).
/// @throws GeometryError `source:line: ...` for a vertex where an odd number of segments meets
std::vector<std::vector<RingVertex>> rings_of_segments(const std::vector<FileVertex>& vertices,
                                                       std::vector<FileSegment> segments, const std::string& source,
                                                       std::vector<std::string>& warnings);

} // namespace trime::contours
