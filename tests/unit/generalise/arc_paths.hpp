// SPDX-License-Identifier: BSD-3-Clause
// Makes arcs inside a shape, and loops around it, from paths of vertices.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <vector>

namespace trime::generalise {

/// Returns the straight pieces of a path. @param part curve or part of the shape @param region region of a boundary
inline std::vector<geometry::Piece> pieces_of(const std::vector<geometry::Vec2>& path, int part, int region = 0) {
  std::vector<geometry::Piece> made;
  for (std::size_t k = 1; k < path.size(); ++k) {
    geometry::Piece& piece = made.emplace_back();
    piece.start = path[k - 1];
    piece.end = path[k];
    piece.part = part;
    piece.region = region;
  }
  return made;
}

/// Returns an open arc along a path. @param left, right regions on both sides
inline geometry::InnerArc arc_of(const std::vector<geometry::Vec2>& path, int part, int left, int right) {
  geometry::InnerArc made;
  made.pieces = pieces_of(path, part);
  made.left = left;
  made.right = right;
  return made;
}

} // namespace trime::generalise
