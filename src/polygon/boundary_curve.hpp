// SPDX-License-Identifier: BSD-3-Clause
// The boundary as curves by arc length, and what lies on the curve between two places.
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
  /// Arc length from the start of the loop to a site.
  double arc(LocalIndex loop, const BoundarySite& site) const {
    return arcs_[static_cast<std::size_t>(loop)].starts[static_cast<std::size_t>(site.piece)] + site.along;
  }
  /// A place within one length of the loop before its start or behind its end. O(1) where pieces are about equally
  /// long, O(log pieces) at worst
  struct CurvePlace {
    LocalIndex piece;
    double along;
    geometry::Vec2 point;   ///< on the unrolled loop
    geometry::Vec2 tangent; ///< unit
  };
  CurvePlace place(LocalIndex loop, double arc) const;

  /// How the curve from one place on to another, less than a length of the loop ahead, differs from the chord a-b
  /// between them (or images of them). O(pieces between)
  struct Strayed {
    double deviation = 0;     ///< largest distance from the chord, of junctions and points on arcs
    double farthest = 0;      ///< arc length there, from the start of the loop; may be above its length
    bool leaves_disc = false; ///< one lies outside of the chord's diametral disc
    bool bent = false;        ///< a junction lies between that turns by more than half a degree
    bool sharp = false;       ///< one that turns by more than 30 degrees
  };
  Strayed strayed(LocalIndex loop, double from, double to, const geometry::Segment& chord) const;

private:
  struct Arcs {                               // of a loop
    std::vector<double> starts;               // of the pieces, and the length
    std::vector<std::uint32_t> first_in_cell; // the first start in each of equal cells of the arc or behind it
    double cells_per_arc = 0;
    std::size_t cell(double arc) const;
    std::size_t piece(double arc) const;
  };
  const geometry::Boundary& boundary_;
  std::vector<Arcs> arcs_; // by loop
};

} // namespace trime::polygon
