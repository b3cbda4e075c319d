// SPDX-License-Identifier: BSD-3-Clause
// Gives the faces of a division that are smaller or narrower than the triangles to their neighbours: gaps and overlaps
// between polygons that were digitised one by one, and crumbs.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"

#include <cstdint>
#include <vector>

namespace trime::shape {

/// A piece between two different regions, or between a region and the outside; or one of a curve, which may have the
/// same region on both sides.
struct LabelledPiece {
  LocalIndex from, to;     ///< vertices of the arrangement
  geometry::Piece piece;   ///< from `from` to `to`
  int left = 0, right = 0; ///< regions on both sides; -1 outside of the shape
  LocalIndex number = 0;   ///< for the caller
  bool on_curve = false;   ///< a curve of the user leads along the piece
};

/// The smallest faces that stay.
struct LeastFace {
  double perimeter = 0; ///< faces with a shorter one are crumbs
  double width = 0;     ///< faces are slivers if twice their area divided by their perimeter is less
  double gap = 0;       ///< least width of faces of region 0, the rest
};

/// @brief Gives each face with a short perimeter or a small width to the region with which it shares the longest
/// border without a curve, the smallest faces first. Curves inside a face divide it not; those along its border stay,
/// with the regions that they have then. Other pieces between equal regions are removed. A face of the shape that
/// touches only the outside stays. Cost: O(n log n) for each of a few rounds.
geometry::AbsorbedFaces absorb_small_faces(std::vector<LabelledPiece>& pieces, const LeastFace& least);

} // namespace trime::shape
