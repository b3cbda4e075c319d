// SPDX-License-Identifier: BSD-3-Clause
// Makes rings from vertices in reading order, regardless of the file format.
#pragma once

#include "trime/contours/contour.hpp"

namespace trime::contours {

/// Makes the rings of a contour. Removes repeated vertices and refuses rings that are too short.
class RingBuilder {
public:
  /// @param contour names its source; receives rings and warnings, and outlives this object
  explicit RingBuilder(Contour& contour) : contour_(contour) {}

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
  int merged_ = 0;
};

} // namespace trime::contours
