// SPDX-License-Identifier: BSD-3-Clause
// Curves that are rougher than the resolution, made as smooth as it.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <memory>

namespace trime::generalise {

struct SmoothedCurves {
  geometry::Boundary boundary;
  std::int64_t vertices = 0; ///< of the given curves that others stand for
};

/// @brief The boundary with its ragged runs smoothed: where it turns to and fro within a size or so, by curve
/// shortening flow, until the turns are gone or features of `reach` are. Under this flow simple curves stay simple and
/// do not meet (Grayson, J. Diff. Geom. 26, 1987); each loop keeps its area. Curves that turn one way only stay, as do
/// corners with smooth arms, arcs, and vertices that the user has asked for: next to these curves may come to cross in
/// rare cases, and the caller finds out. Null if nothing is ragged. O(pieces + length / h) a step, and steps are few.
/// @param reach [h]
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<SmoothedCurves> smooth_ragged_runs(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                                   const geometry::Lattice& lattice, double reach);

} // namespace trime::generalise
