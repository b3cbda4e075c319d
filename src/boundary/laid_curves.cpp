// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/laid_curves.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace trime::boundary {
namespace {

using geometry::Boundary;
using geometry::InnerArc;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

Piece back(Piece piece) {
  std::swap(piece.start, piece.end);
  piece.start_angle += piece.sweep;
  piece.sweep = -piece.sweep;
  return piece;
}

Loop loop_of(const InnerArc& arc) {
  Loop loop;
  loop.pieces = arc.pieces;
  loop.winding = arc.winding;
  if (arc.closed)
    return loop;
  loop.turning = arc.pieces.size();
  for (std::size_t k = arc.pieces.size(); k > 0; --k)
    loop.pieces.push_back(back(arc.pieces[k - 1]));
  Piece &start = loop.pieces.front(), &end = loop.pieces[loop.turning];
  start.corner = end.corner = true;
  start.wedge = arc.start_wedge;
  end.wedge = arc.end_wedge;
  return loop;
}

} // namespace

LaidCurves::LaidCurves(const Boundary& boundary, const geometry::InnerCurves& inner, std::span<const Vec2> corners)
    : boundary_(boundary), inner_(inner) {
  if (inner.empty())
    return;
  joined_.emplace(boundary);
  const geometry::Periods& periods = boundary.periods;
  const auto key = [&](Vec2 node) {
    const Vec2 canonical = periods.wrap(node);
    return std::pair(canonical.x, canonical.y);
  };
  std::map<std::pair<double, double>, double> wedges; // by node
  for (const InnerArc& arc : inner.arcs) {
    joined_->loops.push_back(loop_of(arc));
    if (arc.closed)
      continue;
    const Vec2 start = arc.pieces.front().start, end = arc.pieces.back().end;
    wedges[key(start)] = arc.start_wedge;
    wedges[key(end)] = arc.end_wedge;
  }
  for (std::size_t k = 0; k < boundary_loops(); ++k)
    for (Piece& piece : joined_->loops[k].pieces)
      if (const auto node = wedges.find(key(piece.start)); node != wedges.end())
        piece.wedge = node->second;
  for (std::size_t k = boundary_loops(); k < joined_->loops.size() && !corners.empty(); ++k)
    for (Piece& piece : joined_->loops[k].pieces)
      piece.corner |= std::binary_search(corners.begin(), corners.end(), periods.wrap(piece.start),
                                         geometry::lexicographically_less);
}

} // namespace trime::boundary
