// SPDX-License-Identifier: BSD-3-Clause
#include "shape/inner_pieces.hpp"

#include "geometry/piece_parts.hpp"

#include "trime/core/error.hpp"

#include <utility>

namespace trime::shape {

using geometry::Piece;
using geometry::Vec2;

void InnerPieces::look_at(LocalIndex k, const Side& left, const Side& right, Vec2 middle) {
  const Arrangement::Piece& piece = arrangement_.pieces()[k];
  if (!is_here(piece, left, right))
    return;
  const auto [curve, along_curve] = curve_of(piece);
  const bool is_inside = left.is_region && right.is_region, is_interface = is_inside && left.region != right.region;
  if (curve >= 0 && !is_inside) {
    const auto c = static_cast<std::size_t>(curve);
    const bool is_outside = !left.is_region && !right.is_region;
    (is_outside ? outside_ : on_boundary_)[c] +=
        geometry::length(arrangement_.vertices().point(piece.to) - arrangement_.vertices().point(piece.from));
    if (is_outside && (inner_.clip.empty() || inner_.clip[c] == 0))
      report_outside(curve, middle);
  }
  if (!is_inside || (curve < 0 && !is_interface))
    return;
  const bool along = curve >= 0 ? along_curve : left.region < right.region;
  CurvePiece& kept = pieces_.emplace_back();
  kept.from = along ? piece.from : piece.to;
  kept.to = along ? piece.to : piece.from;
  kept.left = along ? left.region : right.region;
  kept.right = along ? right.region : left.region;
  kept.piece = piece_along(piece, along);
  kept.piece.part = curve;
}

/// Does the piece lie in the container, and if it is one of two images on opposite sides, on the lower one?
bool InnerPieces::is_here(const Arrangement::Piece& piece, const Side& left, const Side& right) const {
  if (left.in_container == right.in_container)
    return left.in_container;
  const Vec2 along = arrangement_.vertices().point(piece.to) - arrangement_.vertices().point(piece.from);
  const Vec2 to_left = geometry::left_normal(along);
  return (to_left.x + to_left.y > 0) == left.in_container;
}

/// The first curve that runs along the piece.
InnerPieces::OnCurve InnerPieces::curve_of(const Arrangement::Piece& piece) const {
  const auto number = [this](int place) { return placed_[static_cast<std::size_t>(place)].index - first_curve_; };
  if (number(piece.part) >= 0)
    return {number(piece.part), true};
  for (LocalIndex t = piece.first_twin; t < piece.first_twin + piece.twin_count; ++t)
    if (const Arrangement::Twin& twin = arrangement_.twins()[t]; number(twin.part) >= 0)
      return {number(twin.part), twin.along};
  return {-1, true};
}

Piece InnerPieces::piece_along(const Arrangement::Piece& piece, bool along) const {
  const Vec2 from = arrangement_.vertices().point(piece.from), to = arrangement_.vertices().point(piece.to);
  Piece made;
  if (piece.circle >= 0) {
    made = make_arc(arrangement_.circles()[piece.circle], from, to);
    return along ? made : reversed(made);
  }
  made.start = along ? from : to;
  made.end = along ? to : from;
  return made;
}

void InnerPieces::report_outside(int curve, Vec2 place) const {
  const Part& part = inner_.curves[static_cast<std::size_t>(curve)];
  const auto nearest = part.as_polygon()->grid.nearest(place);
  const std::string& label = part.as_polygon()->labels[static_cast<std::size_t>(nearest.segment)];
  throw GeometryError(
      fmt::format("curve '{}'{} lies outside of the shape at {}: expected curves inside of the geometry "
                  "'{}'; move it, or set clip = true to leave out what lies outside",
                  part.name(), label.empty() ? "" : fmt::format(" ({})", label), Place(place, 12), text_));
}

namespace {

/// The piece between exact images of its nodes.
CurvePiece between_nodes(CurvePiece piece, const VertexTable& vertices, const Quotient& nodes) {
  const auto place_of = [&](LocalIndex vertex) { return nodes.point(nodes.node(vertex)) + nodes.shift(vertex); };
  const Vec2 from = place_of(piece.from), to = place_of(piece.to);
  if (from != vertices.point(piece.from) || to != vertices.point(piece.to)) {
    const Piece given = piece.piece;
    if (given.circular) {
      const Circle circle{given.center, given.radius};
      piece.piece = given.sweep > 0 ? make_arc(circle, from, to) : reversed(make_arc(circle, to, from));
      piece.piece.part = given.part;
    }
    piece.piece.start = from;
    piece.piece.end = to;
  }
  piece.from = nodes.node(piece.from);
  piece.to = nodes.node(piece.to);
  return piece;
}

} // namespace

geometry::InnerCurves InnerPieces::curves(const std::vector<char>& on_boundary, const Quotient& nodes,
                                          const geometry::Boundary& boundary) {
  geometry::InnerCurves curves;
  for (const Part& curve : inner_.curves)
    curves.names.push_back(curve.name());
  curves.kinds = inner_.kinds;
  curves.on_boundary = std::move(on_boundary_);
  curves.outside = std::move(outside_);
  for (CurvePiece& piece : pieces_)
    piece = between_nodes(piece, arrangement_.vertices(), nodes);
  curves.arcs = join_pieces(std::move(pieces_), on_boundary, boundary);
  return curves;
}

} // namespace trime::shape
