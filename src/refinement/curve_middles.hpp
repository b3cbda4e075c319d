// SPDX-License-Identifier: BSD-3-Clause
// Finds the curve of a shape between the ends of a boundary edge, and the point in the middle of this curve.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace trime::refinement {

/// A point in the middle of a curve.
struct CurveMiddle {
  geometry::Vec2 place;
  bool is_on_curve; ///< whether it lies on the curve, and not only near it
};

/// The boundary of a shape, prepared for the search. Immutable; the same on every rank.
class CurveMiddles {
public:
  /// @param side longer side of the container @pre the boundary outlives this object
  CurveMiddles(const geometry::Boundary& boundary, double side);

  /// @brief Returns the point at half the length of the curve from `a` to `b`, or nothing. There is
  /// no such point if an end does not lie on the boundary, or if the curve between them is much longer than the edge or
  /// strays far from it. The middle must not belong to another part of the shape. If the ends lie near
  /// the curve, as they do where the boundary was simplified a little, so does the result. It lies near the middle of a
  /// and b, and is not rounded.
  /// @param b the image of the second end next to `a`; the interior lies on the left of a -> b
  /// @param part of the boundary edge, as an index into Boundary::part_names
  /// Cost: O(log(pieces)). Thread-safe.
  std::optional<CurveMiddle> middle(geometry::Vec2 a, geometry::Vec2 b, int part) const;

private:
  /// A place on the boundary.
  struct Along {
    std::size_t loop;
    double length;       ///< from the start of the loop
    geometry::Vec2 away; ///< from there to the point
  };
  /// The curve between two points.
  struct Way {
    Along from;
    double length;
    geometry::Vec2 away; ///< mean of both ends
  };
  std::vector<Along> places_of(geometry::Vec2 p, double tolerance) const;
  void add_places(std::size_t piece, geometry::Vec2 p, double tolerance, std::vector<Along>& places) const;
  std::optional<Way> way_between(geometry::Vec2 a, geometry::Vec2 b) const;
  const geometry::Piece& piece(std::size_t number) const { return *pieces_[number]; }

  const geometry::Boundary& boundary_;
  geometry::PieceTree tree_;
  double tolerance_;
  std::vector<const geometry::Piece*> pieces_; // the pieces of all loops, in their order
  std::vector<std::size_t> loop_of_;           // by piece
  std::vector<double> start_;                  // by piece: length of its loop before it
  std::vector<std::size_t> first_;             // by loop: its first piece; the last entry is the end
  std::vector<double> length_;                 // by loop
};

} // namespace trime::refinement
