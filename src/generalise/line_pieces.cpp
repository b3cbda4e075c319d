// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/line_pieces.hpp"

#include "generalise/meeting_pieces.hpp"
#include "geometry/piece_parts.hpp"

#include <algorithm>
#include <cmath>

namespace trime::generalise {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

Vec2 nearest_on(const Piece& piece, Vec2 p) {
  if (piece.circular) {
    const Vec2 out = p - piece.center, there = piece.center + (piece.radius / length(out)) * out;
    const bool is_on = piece.distance(there) < 1e-6 * piece.radius;
    return is_on ? there : squared_length(p - piece.start) < squared_length(p - piece.end) ? piece.start : piece.end;
  }
  const Vec2 along = piece.end - piece.start;
  const double share = std::clamp(dot(p - piece.start, along) / squared_length(along), 0.0, 1.0);
  return piece.start + share * along;
}

double way_on(const Piece& piece, Vec2 p) {
  if (p == piece.start)
    return 0;
  if (p == piece.end)
    return piece.length();
  if (!piece.circular)
    return length(p - piece.start);
  const double way = geometry::divided(piece, p)[0].length(), whole = piece.length();
  if (way <= whole)
    return way;
  return squared_length(p - piece.start) < squared_length(p - piece.end) ? 0 : whole; // rounding led beyond an end
}

LinePieces::LinePieces(const geometry::Boundary& boundary, const std::vector<InnerArc>& arcs) {
  geometry::Boundary all = boundary;
  for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop)
    add(rim, loop, boundary.loops[loop].pieces);
  for (std::size_t arc = 0; arc < arcs.size(); ++arc) {
    first_of_.push_back(lines_.size());
    all.loops.emplace_back().pieces = arcs[arc].pieces;
    add(static_cast<int>(arc), 0, arcs[arc].pieces);
  }
  tree_ = geometry::PieceTree(all);
}

void LinePieces::add(int arc, std::size_t loop, const std::vector<Piece>& pieces) {
  double way = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    lines_.push_back({arc, loop, k, way, &pieces[k]});
    way += pieces[k].length();
  }
  if (arc != rim)
    length_of_.push_back(way);
}

bool LinePieces::is_own(std::size_t piece, const OwnPieces& own) const {
  const Line& line = lines_[piece];
  return line.arc != rim && static_cast<std::size_t>(line.arc) == own.arc && line.number >= own.first &&
         line.number <= own.last;
}

bool LinePieces::meets(const Piece& edge, std::size_t except, const OwnPieces& own) const {
  return std::ranges::any_of(within(0.5 * (edge.start + edge.end), 0.5 * edge.length()), [&](std::size_t k) {
    return k != except && !is_own(k, own) && meet(edge, *lines_[k].piece);
  });
}

} // namespace trime::generalise
