// SPDX-License-Identifier: BSD-3-Clause
// Smooths curves that are rougher than the resolution of the mesh.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace trime::generalise {

struct SmoothedCurves {
  geometry::Boundary boundary;
  std::int64_t vertices = 0; ///< number of vertices of the given curves that were replaced
};

/// @brief Returns the boundary with its ragged stretches smoothed. Where a curve turns back and forth within about h,
/// curve-shortening flow moves it until these turns, or features of the size `reach`, are gone. Under this flow simple
/// curves stay simple and do not meet (Grayson, J. Diff. Geom. 26, 1987); each loop keeps its area. Curves that turn in
/// one direction only, corners with smooth sides, arcs, and vertices that the user asked for do not move. Next to
/// these, curves may cross in rare cases; the caller must check. Returns null if no curve is ragged. Cost: O(pieces +
/// length / h) for each of a few steps.
/// @param reach [h] features of this size are smoothed away
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<SmoothedCurves> smooth_ragged_runs(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                                   const geometry::Lattice& lattice, double reach);

/// Holds the input of the smoothing of arcs.
struct FlowRequest {
  const sizing::SizeField& size;
  geometry::Box bounds;                 ///< no vertex leaves this box
  double reach;                         ///< [h] features of this size are smoothed away
  std::span<const geometry::Vec2> kept; ///< vertices that stay, in lexicographic order
};

/// @brief Returns the pieces of an arc between two regions with its ragged stretches smoothed, as in
/// smooth_ragged_runs(); nothing if it is not ragged. The ends stay bit for bit. The areas on both sides change by a
/// small share of h times the length; boundary::keep_areas restores them.
/// @throws GeometryError if a size is not positive and finite
std::optional<std::vector<geometry::Piece>> smoothed_arc(const geometry::InnerArc& arc, const FlowRequest& request,
                                                         const geometry::Lattice& lattice);

} // namespace trime::generalise
