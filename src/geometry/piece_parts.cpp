// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/piece_parts.hpp"

#include "core/angle.hpp"

#include <utility>

namespace trime::geometry {

std::array<Piece, 2> divided(const Piece& piece, Vec2 p) {
  std::array<Piece, 2> parts{piece, piece};
  parts[0].end = parts[1].start = p;
  if (piece.circular) {
    const Vec2 from = piece.start - piece.center, to = p - piece.center;
    double sweep = angle_of(cross(from, to), dot(from, to));
    if (piece.sweep > 0 && sweep < 0)
      sweep += 2 * pi;
    if (piece.sweep < 0 && sweep > 0)
      sweep -= 2 * pi;
    parts[0].sweep = sweep;
    parts[1].sweep = piece.sweep - sweep;
    parts[1].start_angle = angle_of(to.y, to.x);
  }
  parts[1].corner = true;
  return parts;
}

Piece reversed(Piece piece) {
  std::swap(piece.start, piece.end);
  if (piece.circular) {
    const Vec2 from = piece.start - piece.center;
    piece.start_angle = angle_of(from.y, from.x);
    piece.sweep = -piece.sweep;
  }
  return piece;
}

} // namespace trime::geometry
