// SPDX-License-Identifier: BSD-3-Clause
// Simplifies the boundary of a shape to the resolution of a mesh: removes or widens parts that are narrower than the
// triangles.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cmath>
#include <memory>
#include <span>

namespace trime::generalise {

/// [h] Largest distance of simplified curves from the given ones. All shares of h in this module are chosen for it; for
/// another distance, the caller scales the size.
inline constexpr double reference_distance = 0.5;

/// Options of the simplification.
struct Choice {
  bool closes_narrow = false;        ///< slits, cracks and walls are closed; else their sides are moved apart
  bool keeps_joining = true;         ///< what is connected stays connected, and what is separate stays separate
  bool cuts_thin_components = false; ///< components that are narrow all over are cut to pieces, not widened
  geometry::Box bounds = {{-INFINITY, -INFINITY},
                          {INFINITY, INFINITY}}; ///< lattice points; no vertex is moved out of it
};

struct Generalised {
  geometry::Boundary boundary;
  polygon::Simplification counts;
};

/// @brief Returns the boundary without vertices that are much closer together than this size, in loops that have far
/// too many of them. Null if there are no such loops, and in a periodic container. O(n log n)
/// @param size h
/// @param inside lattice points that must stay inside, otherwise the result is null; points outside the boundary are
/// ignored
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<const geometry::Boundary> thinned(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                                  const geometry::Lattice& lattice,
                                                  std::span<const geometry::Vec2> inside);

/// @brief Returns the boundary without narrow parts for elements of this size; null if it has no narrow parts.
///
/// The curves are the constraints of a Delaunay triangulation of their nodes. Parts whose triangles are all narrow are
/// dead ends (spits, inlets), passages (necks, straits, walls) or whole components and holes. Those of the shape are
/// cut where they become wide enough, unless they join or separate what is larger than the resolution (see
/// judge_parts): then they are widened as far as the size can be lowered to them. Components that are narrow all over
/// are widened. Those of the outside are kept, and their sides moved apart, or closed. Triangles that keep their
/// orientation prove that curves do not cross. Then ragged runs are smoothed, see curve_flow.hpp, and a triangulation
/// of the result proves the same. Periodic boundaries come back as they are. Deterministic, one thread. O(n log n) for
/// n pieces.
/// @param size h
/// @param inside lattice points that must stay inside: a narrow part with such a point is not cut, and no curve moves
/// over one. Points outside the given boundary are ignored.
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<Generalised> generalise(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                        const geometry::Lattice& lattice, const Choice& choice,
                                        std::span<const geometry::Vec2> inside);

/// Returns whether generalise() would change anything. Takes the time of one of its passes.
bool would_generalise(const geometry::Boundary& boundary, const sizing::SizeField& size,
                      const geometry::Lattice& lattice, const Choice& choice, std::span<const geometry::Vec2> inside);

} // namespace trime::generalise
