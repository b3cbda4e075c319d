// SPDX-License-Identifier: BSD-3-Clause
// Refines a coarse closed polygon on a zero set until it follows the zero set closely. Edges (chords) are halved until
// they are near enough, corners are computed to full accuracy, and superfluous vertices are removed.
#pragma once

#include "tracing/level_function.hpp"

#include <optional>
#include <vector>

namespace trime::tracing {

/// The tolerances that give the accuracy of traced_part, as lengths.
struct TraceTolerances {
  explicit TraceTolerances(double container_side) : side(container_side) {}
  double side; ///< longer side of the container
  double chord =
      2.5e-7 * side; ///< largest deviation of a chord from the curve during refinement; twice that after thinning
  double straight = 1e-12 * side;   ///< a deviation up to this counts as zero
  double shortest = 0x1p-22 * side; ///< chords below this length are not halved
  double corner = 0x1p-24 * side;   ///< distance from a corner at which its two sides are examined last
  double zero = 0x1p-50 * side;     ///< largest error of the place where the level function is zero on a segment
};

struct CurveVertex {
  geometry::Vec2 place;
  bool keep = false; ///< true for corners and for the ends of straight sides
};

class CurveRefiner {
public:
  /// @param resolution resolution of the grid with which the chains were found, for messages
  CurveRefiner(const LevelFunction& function, const TraceTolerances& tolerances, double resolution)
      : function_(function), tolerances_(tolerances), resolution_(resolution) {}

  /// @brief Returns a closed polygon along the curve.
  /// @param chain a closed polygon with the interior on its left and at least three vertices
  /// @throws GeometryError with a place if a chord, or all chains so far, would need too many vertices
  std::vector<geometry::Vec2> refine(const std::vector<geometry::Vec2>& chain);

private:
  std::vector<geometry::Vec2> halve_chords(const std::vector<geometry::Vec2>& chain);
  bool halve(geometry::Vec2 a, geometry::Vec2 b, int depth, std::vector<geometry::Vec2>& to) const;
  [[noreturn]] void fail_for_oscillation(geometry::Vec2 place, std::size_t vertices) const;
  bool is_near(geometry::Vec2 a, geometry::Vec2 b) const;
  std::optional<geometry::Vec2> curve_beside(geometry::Vec2 a, geometry::Vec2 b) const;

  std::vector<CurveVertex> insert_corners(const std::vector<geometry::Vec2>& polygon) const;
  std::optional<geometry::Vec2> corner_in_chord(geometry::Vec2 before, geometry::Vec2 a, geometry::Vec2 b,
                                                geometry::Vec2 after) const;
  std::optional<geometry::Vec2> corner_at(geometry::Vec2 guess, geometry::Vec2 back, geometry::Vec2 ahead,
                                          double distance) const;
  std::optional<geometry::Vec2> on_arm(geometry::Vec2 near, geometry::Vec2 along, double distance) const;

  const LevelFunction& function_;
  const TraceTolerances tolerances_;
  const double resolution_;
  std::size_t vertices_ = 0; // number of vertices of all chains so far, before thinning
};

/// @brief Removes vertices of a closed polygon. Vertices on a line become one segment; other sequences of vertices
/// become chords whose distance from the removed vertices is at most `chord`. Vertices marked `keep` stay.
std::vector<geometry::Vec2> thinned(std::vector<CurveVertex> polygon, double straight, double chord);

} // namespace trime::tracing
