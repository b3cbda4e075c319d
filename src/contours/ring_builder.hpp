// SPDX-License-Identifier: BSD-3-Clause
// Rings out of vertices in reading order, whatever the format they come from.
#pragma once

#include "trime/contours/contour.hpp"

namespace trime::contours {

/// Knows about repeated vertices and rings that are too short, not about text.
class RingBuilder {
public:
  /// @param contour with its source; gets rings and warnings, and outlives this object
  explicit RingBuilder(Contour& contour) : contour_(contour) {}

  /// What messages say behind the line from here on, such as " (feature 3)".
  void set_feature(const std::string& feature) { feature_ = feature; }
  /// @param marker of the edge from this vertex to the next
  /// @throws GeometryError for coordinates that are too large
  void add(geometry::Vec2 p, int line, int marker = 0);
  /// @throws GeometryError for a ring with fewer than three distinct vertices
  void end_ring();
  /// @param expected what the text should have held, for the message if it holds no vertex
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

} // namespace trime::contours
