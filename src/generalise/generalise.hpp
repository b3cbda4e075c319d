// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a shape at the resolution of a mesh: without parts that are narrower than its triangles.
#pragma once

#include "polygon/simplification.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cmath>
#include <memory>
#include <span>

namespace trime::generalise {

/// [h] Simplified curves lie within this distance of the given ones. All shares of h by which they are made belong to
/// it: for another distance the size is scaled before.
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
/// too many of them. Null if there are no such loops, in a periodic container, and where curves would cross. O(n log n)
/// @param size h
/// @param inside lattice points that must stay inside, else it is null; those outside of the boundary are left out
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<const geometry::Boundary> thinned(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                                  const geometry::Lattice& lattice,
                                                  std::span<const geometry::Vec2> inside);

/// @brief The boundary without narrow parts for elements of this size; null if it has none.
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
/// @param inside lattice points that must stay inside: a narrow part with one of them is not cut, and no curve moves
/// over one. Those that are not inside the given boundary are left out.
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<Generalised> generalise(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                        const geometry::Lattice& lattice, const Choice& choice,
                                        std::span<const geometry::Vec2> inside);

/// Would generalise() change anything? Costs one pass of its several.
bool would_generalise(const geometry::Boundary& boundary, const sizing::SizeField& size,
                      const geometry::Lattice& lattice, const Choice& choice, std::span<const geometry::Vec2> inside);

} // namespace trime::generalise
