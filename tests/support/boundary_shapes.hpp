// SPDX-License-Identifier: BSD-3-Clause
// Makes boundaries for the tests without the code for shapes: polygons and circles with vertices on the coordinate
// lattice of the unit square.
#pragma once

#include "core/angle.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <vector>

namespace trime::testing {

inline const geometry::Lattice& unit_lattice() {
  static const geometry::Lattice lattice(geometry::Box{{0, 0}, {1, 1}});
  return lattice;
}

inline double signed_area(const std::vector<geometry::Vec2>& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += geometry::cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
  return 0.5 * twice;
}

/// Returns a loop of straight pieces between the points, rounded to the lattice. A counter-clockwise loop is an outer
/// loop.
inline geometry::Loop polygon_loop(std::vector<geometry::Vec2> points, int tag = 1) {
  geometry::Loop loop;
  for (geometry::Vec2& p : points)
    p = unit_lattice().snap(p);
  loop.outer = signed_area(points) > 0;
  loop.tag = tag;
  for (std::size_t k = 0; k < points.size(); ++k) {
    geometry::Piece piece;
    piece.start = points[k];
    piece.end = points[(k + 1) % points.size()];
    loop.pieces.push_back(piece);
  }
  return loop;
}

/// Returns a circle as a loop of `arcs` equal arcs; it is clockwise if `hole` is true.
inline geometry::Loop circle_loop(geometry::Vec2 center, double radius, bool hole = false, int arcs = 4, int tag = 1) {
  geometry::Loop loop;
  loop.outer = !hole;
  loop.tag = tag;
  const double sweep = (hole ? -2 : 2) * pi / arcs;
  for (int k = 0; k < arcs; ++k) {
    const auto at = [&](int j) {
      const SinCos direction = sin_cos(sweep * (j % arcs));
      return unit_lattice().snap(center + radius * geometry::Vec2{direction.cos, direction.sin});
    };
    geometry::Piece piece;
    piece.start = at(k);
    piece.end = at(k + 1);
    piece.circular = true;
    piece.center = center;
    piece.radius = radius;
    piece.start_angle = sweep * k;
    piece.sweep = sweep;
    loop.pieces.push_back(piece);
  }
  return loop;
}

inline geometry::Boundary boundary_of(std::vector<geometry::Loop> loops) {
  geometry::Boundary boundary;
  boundary.loops = std::move(loops);
  boundary.part_names = {"shape"};
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces) {
      boundary.area += 0.5 * cross(piece.start, piece.end);
      if (piece.circular)
        boundary.area += 0.5 * piece.radius * piece.radius * (piece.sweep - sin_cos(piece.sweep).sin);
    }
  return boundary;
}

} // namespace trime::testing
