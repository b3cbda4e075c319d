// SPDX-License-Identifier: BSD-3-Clause
// Measures how far simplified curves lie from those of a shape, relative to h. The simplification and the certificate
// both use it.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>

namespace trime::sizing {

/// A place on a curve, its distance from the shape's curves, and h there.
struct CurveDistance {
  geometry::Vec2 place;
  double distance, size;

  double in_sizes() const { return distance / size; }
};

/// @brief Returns the distances of a piece at its start and in its middle. Does not check the size. O(log of the pieces
/// of the shape), thread-safe.
inline std::array<CurveDistance, 2> curve_distances(const geometry::Piece& piece, const geometry::PieceTree& shape,
                                                    const SizeField& asked, const geometry::Periods& periods) {
  const auto at_place = [&](geometry::Vec2 p) {
    return CurveDistance{p, shape.distance(p), asked.size(periods.wrap(p))};
  };
  return {at_place(piece.start), at_place(piece.point(0.5 * piece.length()))};
}

} // namespace trime::sizing
