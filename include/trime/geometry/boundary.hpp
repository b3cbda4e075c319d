// SPDX-License-Identifier: BSD-3-Clause
// What every shape becomes: closed loops of smooth pieces, interior on the left. Plain data.
#pragma once

#include "trime/geometry/periods.hpp"
#include "trime/geometry/vec2.hpp"

#include <string>
#include <vector>

namespace trime::geometry {

/// A straight segment or a circular arc from `start` to `end`; both ends lie on the lattice.
struct Piece {
  Vec2 start, end;
  Vec2 center; ///< circular pieces only, as the three numbers below
  double radius = 0;
  double start_angle = 0; ///< radians
  double sweep = 0;       ///< signed angle from start to end, radians, counter-clockwise positive, |sweep| <= 2 pi
  int part = 0;           ///< index into Boundary::part_names of the part that the piece comes from
  bool circular = false;
  bool corner = false; ///< the start is to be kept as a corner, however little the curve turns there

  /// Arc length.
  double length() const;
  /// Point at arc length s from the start, 0 <= s <= length(); the ends themselves are returned bit for bit.
  Vec2 point(double s) const;
  /// Unit tangent at arc length s.
  Vec2 tangent(double s) const;
  /// Distance from p to the piece.
  double distance(Vec2 p) const;
  /// A box that contains the piece; not tight for arcs.
  Box covering_box() const;
};

/// @brief Closed curve: piece i ends where piece i+1 starts, the last where the first starts, moved by `winding`.
///
/// In a periodic container the pieces stand in a row as if the border were not there ("unrolled"). None lies farther
/// out than one image of the container. The first start is canonical.
struct Loop {
  std::vector<Piece> pieces;
  bool outer = true; ///< counter-clockwise around a component, or clockwise around a hole; true if it winds
  int tag = 1;       ///< value written for its edges, from 1
  Vec2 winding{};    ///< multiple of the periods; zero unless the loop leads around the container

  double length() const;
  /// Turn in degrees, 0..180, at the start of piece i.
  double turn_degrees(std::size_t i) const;
  /// Does it lead around the periodic container?
  bool winds() const { return winding != Vec2{}; }
};

/// The boundary of a shape. Invariant: loops and their images do not cross or touch; area > 0.
struct Boundary {
  std::vector<Loop> loops;
  std::vector<std::string> part_names;
  double area = 0; ///< enclosed area, arcs included
  Periods periods; ///< of the container
  /// One component reaches around the torus both ways: it has hole loops only, or none.
  bool covers_torus = false;

  int components() const; ///< outer loops, bands (two winding loops each), and one if covers_torus
  int holes() const;      ///< number of hole loops
  /// @brief Of the region on the plane, cylinder or torus: outer loops minus holes. By the theorem of Gauss and Bonnet
  /// on a flat surface it is the sum of the turns of the loops: winding loops turn by nothing.
  int euler_characteristic() const;
  double length() const;
  /// Of the loops as they are unrolled; empty without loops.
  Box bounding_box() const;
};

} // namespace trime::geometry
