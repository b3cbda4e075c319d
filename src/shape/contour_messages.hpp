// SPDX-License-Identifier: BSD-3-Clause
// Messages about the rings of a contour on the coordinate lattice, with places as the user knows them from the file.
#pragma once

#include "contours/ring_repair.hpp"
#include "shape/lattice_rings.hpp"
#include "trime/contours/contour.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/shape/part.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace trime::shape {

/// Returns the index of the ring to which a segment belongs, and its line in the file. @param segment as in segments_of
std::pair<std::size_t, int> ring_and_line_of(std::span<const LatticeRing> rings, LocalIndex segment);

/// Makes the messages about one contour, which must outlive this object.
class ContourMessages {
public:
  ContourMessages(const contours::Contour& contour, const contours::Normalization& normalization)
      : contour_(contour), normalization_(normalization) {}

  /// Returns a place in the coordinates of the file; where these are projected, that of the nearest place on an edge.
  /// Cost: O(vertices).
  std::string in_file(geometry::Vec2 p) const;
  contours::PlaceText place_text() const;
  /// @brief Returns the fault that two segments meet.
  /// @param grid of the segments of the rings
  /// @param united whether the polygons of the contour will be united
  contours::Fault meeting(std::span<const LatticeRing> rings, const geometry::SegmentGrid& grid,
                          const SegmentPair& pair, bool united) const;
  /// Adds warnings for rings that are moved apart by `gap`, on the lattice.
  void tell_touches(const std::vector<RingTouch>& touches, double gap, std::vector<std::string>& warnings) const;
  /// Adds a warning for every ring that encloses a separate piece, except the one with the largest area. Maps mean such
  /// pieces. @param polygon is made from the rings, in their order
  void tell_pieces(const Polygon& polygon, std::span<const LatticeRing> rings,
                   std::vector<std::string>& warnings) const;

private:
  std::string other_edge(int line, int other_line) const;

  const contours::Contour& contour_;
  const contours::Normalization& normalization_;
};

} // namespace trime::shape
