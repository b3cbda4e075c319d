// SPDX-License-Identifier: BSD-3-Clause
// Collects the pieces of an arrangement that lie inside a shape and that edges of the mesh must follow: those of
// curves, and those between two regions.
#pragma once

#include "shape/arrangement.hpp"
#include "shape/inner_curves.hpp"
#include "shape/vertex_table.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/shape/region_shape.hpp"

#include <span>
#include <string>
#include <vector>

namespace trime::shape {

/// Describes one side of a piece.
struct Side {
  bool is_region;    ///< whether the side lies in the shape
  bool in_container; ///< always true unless the container is periodic
  int region = 0;    ///< region of the division if the side lies in the shape
};

/// @brief Keeps pieces with the shape on both sides if they belong to a curve or have different regions on their sides.
/// Measures curves elsewhere. Of a piece on the border of a periodic container and its image on the other side it keeps
/// the one on the lower side.
class InnerPieces {
public:
  /// @param first_curve index of the first curve among the indices of placed parts @param text expression of the shape
  InnerPieces(const Arrangement& arrangement, const std::vector<PlacedPart>& placed, const InnerParts& inner,
              int first_curve, const std::string& text)
      : arrangement_(arrangement), placed_(placed), inner_(inner), first_curve_(first_curve), text_(text),
        on_boundary_(inner.curves.size(), 0), outside_(inner.curves.size(), 0) {}

  /// @param middle of the piece, for messages
  /// @throws GeometryError if a curve that may not be clipped lies outside
  void look_at(LocalIndex piece, const Side& left, const Side& right, geometry::Vec2 middle);

  bool is_on_curve(const Arrangement::Piece& piece) const { return curve_of(piece).curve >= 0; }
  /// Returns the pieces: those of curves in the direction of the curve, others with the lower region on the left.
  const std::vector<CurvePiece>& pieces() const { return pieces_; }
  /// Returns the arcs together with the names and lengths of the curves. Frees the pieces.
  /// @param on_boundary by node: whether it lies on the boundary @param nodes of all pieces
  geometry::InnerCurves curves(const std::vector<char>& on_boundary, const Quotient& nodes,
                               const geometry::Boundary& boundary);

private:
  struct OnCurve {
    int curve; ///< -1: none
    bool along;
  };
  OnCurve curve_of(const Arrangement::Piece& piece) const;
  bool is_here(const Arrangement::Piece& piece, const Side& left, const Side& right) const;
  geometry::Piece piece_along(const Arrangement::Piece& piece, bool along) const;
  [[noreturn]] void report_outside(int curve, geometry::Vec2 place) const;

  const Arrangement& arrangement_;
  const std::vector<PlacedPart>& placed_;
  const InnerParts& inner_;
  const int first_curve_;
  const std::string& text_;
  std::vector<CurvePiece> pieces_;
  std::vector<double> on_boundary_, outside_; // lengths by curve
};

} // namespace trime::shape
