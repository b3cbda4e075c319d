// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/boundary_curve.hpp"

#include "polygon/rules.hpp"

#include <algorithm>
#include <cmath>

namespace trime::polygon {

using geometry::Vec2;

BoundaryCurve::BoundaryCurve(const geometry::Boundary& boundary) : boundary_(boundary) {
  for (const geometry::Loop& loop : boundary.loops) {
    Arcs arcs{{0}, {}, 0};
    for (const geometry::Piece& piece : loop.pieces)
      arcs.starts.push_back(arcs.starts.back() + piece.length());
    arcs.cells_per_arc = static_cast<double>(loop.pieces.size()) / arcs.starts.back();
    for (std::size_t k = 0; k < arcs.starts.size(); ++k)
      arcs.first_in_cell.resize(std::max(arcs.first_in_cell.size(), arcs.cell(arcs.starts[k]) + 1),
                                static_cast<std::uint32_t>(k));
    arcs.first_in_cell.push_back(static_cast<std::uint32_t>(arcs.starts.size()));
    arcs_.push_back(std::move(arcs));
  }
}

std::size_t BoundaryCurve::Arcs::cell(double arc) const {
  const double place = arc * cells_per_arc;
  return place > 0 ? static_cast<std::size_t>(std::fmin(place, static_cast<double>(starts.size()))) : 0;
}

/// The last one that begins at this arc or before, in [0, pieces - 1]. Cells are monotone in the arc, so that no start
/// in a cell before lies behind it, and none in a cell behind lies before it.
std::size_t BoundaryCurve::Arcs::piece(double arc) const {
  const std::size_t its_cell = std::min(cell(arc), first_in_cell.size() - 2);
  const auto begin = starts.begin();
  const auto above = std::upper_bound(begin + first_in_cell[its_cell], begin + first_in_cell[its_cell + 1], arc);
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - begin - 1, 0, std::ssize(starts) - 2));
}

BoundaryCurve::CurvePlace BoundaryCurve::place(LocalIndex loop, double arc) const {
  const Arcs& arcs = arcs_[at(loop)];
  const geometry::Loop& curve = boundary_.loops[at(loop)];
  const double length = arcs.starts.back(), turns = arc >= length ? 1 : arc < 0 ? -1 : 0;
  arc -= turns * length;
  const std::size_t piece = arcs.piece(arc);
  const double along = arc - arcs.starts[piece];
  const geometry::Piece& on = curve.pieces[piece];
  return {static_cast<LocalIndex>(piece), along, on.point(along) + turns * curve.winding, on.tangent(along)};
}

BoundaryCurve::Strayed BoundaryCurve::strayed(LocalIndex loop, double from, double to,
                                              const geometry::Segment& chord) const {
  const std::vector<double>& starts = arcs_[at(loop)].starts;
  const geometry::Loop& curve = boundary_.loops[at(loop)];
  if (to < from)
    to += starts.back();
  const CurvePlace first = place(loop, from);
  const Vec2 shift = chord.a - first.point;
  const double rounding = 1e-9 * geometry::squared_length(chord.b - chord.a);
  Strayed result;
  double squared = 0;
  const auto look = [&](Vec2 p, double arc) {
    if (const double distance = geometry::squared_distance(p, chord); distance > squared) {
      squared = distance;
      result.farthest = arc;
    }
    result.leaves_disc |= geometry::dot(chord.a - p, chord.b - p) > rounding;
  };
  Vec2 moved = shift;
  double turns = from >= starts.back() ? 1 : from < 0 ? -1 : 0;
  double passed = from - first.along; // arc at the start of the piece
  std::size_t k = static_cast<std::size_t>(first.piece);
  for (std::size_t visited = 0; visited <= curve.pieces.size() && passed < to; ++visited) {
    const geometry::Piece& piece = curve.pieces[k];
    const double length = starts[k + 1] - starts[k];
    if (passed > from) {
      look(piece.start + moved, starts[k] + turns * starts.back()); // bit for bit that of the junction
      const geometry::Piece& before = curve.pieces[k == 0 ? curve.pieces.size() - 1 : k - 1];
      const double cosine = geometry::dot(before.tangent(before.length()), piece.tangent(0));
      result.bent |= cosine < PolygonRules::cosine_of_bent;
      result.sharp |= cosine < PolygonRules::cosine_of_sharp;
    }
    for (int quarter = 1; piece.circular && quarter < 4; ++quarter) {
      const double low = std::fmax(from - passed, 0), high = std::fmin(to - passed, length);
      const double along = low + 0.25 * quarter * (high - low);
      look(piece.point(along) + moved, passed + along);
    }
    passed += length;
    if (++k == curve.pieces.size()) {
      k = 0;
      ++turns;
      moved = moved + curve.winding;
    }
  }
  result.deviation = std::sqrt(squared);
  return result;
}

} // namespace trime::polygon
