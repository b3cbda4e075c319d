// SPDX-License-Identifier: BSD-3-Clause
// Simplifies the boundary of a shape to the resolution of a mesh: removes or widens parts that are narrower than the
// triangles.
#pragma once

#include "polygon/polygon.hpp"
#include "sizing/remembered_size.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cmath>
#include <memory>
#include <span>

namespace trime::generalise {

/// [h] Largest distance of simplified curves from the given ones. All limits of this module that are given in h belong
/// to this distance; for another distance, the caller scales the size.
inline constexpr double reference_distance = 0.5;

/// Options of the simplification.
struct Choice {
  bool closes_narrow = false; ///< true: slits, cracks and walls are filled; false: their sides are moved apart
  bool keeps_joining = true; ///< parts of the shape that are connected stay connected, and separate parts stay separate
  bool cuts_thin_components = false; ///< components that are narrow everywhere are cut to pieces instead of widened
  geometry::Box bounds = {{-INFINITY, -INFINITY},
                          {INFINITY, INFINITY}}; ///< a box with lattice points as corners; no vertex is moved out of it
};

struct Generalised {
  geometry::Boundary boundary;
  polygon::Simplification counts;
};

/// Computes the sizes at those vertices of the boundary at which `size` does not know them yet. Uses all threads.
/// Local. Rethrows what the field throws.
/// @pre no other thread uses `size`
void remember_at_vertices(const geometry::Boundary& boundary, sizing::RememberedSize& size);

/// @brief Returns the boundary with fewer vertices in loops that have far too many: vertices much closer together than
/// the size are removed. Returns null if there are no such loops, and in a periodic container. Cost: O(n log n).
/// @param size size field with the target edge length h
/// @param inside lattice points that must stay inside; if one would not, the result is null. Points outside of the
/// boundary are ignored
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<const geometry::Boundary> thinned(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                                  const geometry::Lattice& lattice,
                                                  std::span<const geometry::Vec2> inside);

/// @brief Returns the boundary without parts that are narrower than elements of this size; null if it has no such
/// parts.
///
/// The curves are constraints of a Delaunay triangulation of their nodes. Parts whose triangles are all narrow are dead
/// ends (spits, inlets), passages (necks, straits, walls), or whole components and holes. Narrow parts of the shape are
/// cut where they become wide enough, unless they join or separate areas larger than the triangles (see judge_parts):
/// then they are widened as far as the size can be lowered to them. Components that are narrow everywhere are widened.
/// Narrow parts of the outside are kept and their sides moved apart, or they are filled. Curves do not cross, because
/// all triangles keep their orientation. Then ragged stretches are smoothed, see curve_flow.hpp; a triangulation of the
/// result shows again that curves do not cross. A periodic boundary is returned unchanged. Deterministic; uses one
/// thread, but asks for the sizes at the vertices with all threads. Cost: O(n log n) for n pieces.
/// @param size size field with the target edge length h
/// @param inside lattice points that must stay inside: a narrow part with such a point is not cut, and no curve moves
/// over one. Points outside of the given boundary are ignored
/// @throws GeometryError if a size is not positive and finite
std::unique_ptr<Generalised> generalise(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                        const geometry::Lattice& lattice, const Choice& choice,
                                        std::span<const geometry::Vec2> inside);

/// Returns whether generalise() would change the boundary. Takes as long as one pass of generalise().
bool would_generalise(const geometry::Boundary& boundary, const sizing::SizeField& size,
                      const geometry::Lattice& lattice, const Choice& choice, std::span<const geometry::Vec2> inside);

} // namespace trime::generalise
