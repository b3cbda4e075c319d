// SPDX-License-Identifier: BSD-3-Clause
// The boundary as curves by arc length. Compares the curve between two places with its chord.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::polygon {

/// @brief Places on the loops of a boundary by arc length. Immutable, thread-safe; keeps a reference to the boundary.
/// O(pieces) memory.
class BoundaryCurve {
public:
  explicit BoundaryCurve(const geometry::Boundary& boundary);

  const geometry::Boundary& boundary() const { return boundary_; }
  double length(LocalIndex loop) const { return arcs_[static_cast<std::size_t>(loop)].starts.back(); }
  /// Returns the arc length from the start of the loop to a site.
  double arc(LocalIndex loop, const BoundarySite& site) const {
    return arcs_[static_cast<std::size_t>(loop)].starts[static_cast<std::size_t>(site.piece)] + site.along;
  }
  /// A place on a loop; its arc may lie up to one length of the loop before the start or behind the end. O(1) if pieces
  /// are about equally long, otherwise at most O(log pieces).
  struct CurvePlace {
    LocalIndex piece;
    double along;
    geometry::Vec2 point;   ///< on the unrolled loop
    geometry::Vec2 tangent; ///< unit vector
  };
  CurvePlace place(LocalIndex loop, double arc) const;

  /// How the curve from one place to a later one, less than one length of the loop ahead, differs from the chord a-b
  /// between them or their images. O(pieces between)
  struct Strayed {
    double deviation = 0; ///< largest distance from the chord, of junctions and points on arcs
    double farthest = 0;  ///< arc length of that point from the start of the loop; may exceed the length of the loop
    bool leaves_disc = false; ///< such a point lies outside the diametral disc of the chord
    bool bent = false;        ///< a junction between the places turns by more than half a degree
    bool sharp = false;       ///< a junction between the places turns by more than 30 degrees
  };
  Strayed strayed(LocalIndex loop, double from, double to, const geometry::Segment& chord) const;

private:
  struct Arcs {                               // arc lengths of a loop
    std::vector<double> starts;               // where each piece starts; then the length of the loop
    std::vector<std::uint32_t> first_in_cell; // the first start in each of equal cells of the arc or behind it
    double cells_per_arc = 0;
    std::size_t cell(double arc) const;
    std::size_t piece(double arc) const;
  };
  const geometry::Boundary& boundary_;
  std::vector<Arcs> arcs_; // by loop
};

} // namespace trime::polygon
