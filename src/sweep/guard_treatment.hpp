// SPDX-License-Identifier: BSD-3-Clause
// Keeps inner sites inside the shape, and out of the diametral circles of the boundary edges (chords). A site that
// enters such a circle is pushed out of it; a site that has been pushed too often is deleted.
#pragma once

#include "polygon/boundary_guard.hpp"
#include "sites/stage.hpp"
#include "sweep/update_rule.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::sweep {

/// The data that decide where a site may move.
struct MoveContext {
  const polygon::BoundaryGuard& guard;
  const sizing::SizeField& size;
  const geometry::Lattice& lattice;
};

inline MoveContext move_context(const sites::Stage& stage, const geometry::Lattice& lattice) {
  return {*stage.guard, *stage.size, lattice};
}

/// The next place of one site, and whether the site is pushed out of a diametral circle or marked for deletion.
struct Treated {
  geometry::Vec2 position, lead;
  std::int32_t pushes = 0; ///< number of times that the site has been pushed so far
  bool pushed = false, deleted = false;
};

/// @brief Returns the place to which a step of an update rule moves a site. The step is cut to SweepRules::move_cap
/// (its lead, the momentum part, is shortened first) and rounded to the coordinate lattice. A site that would enter the
/// diametral circle of a boundary edge is pushed out of the circle. A site that has been pushed `pushes_allowed` times
/// is marked for deletion; until its deletion, it is pushed as before.
Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int pushes_allowed);
/// Does the work of treat_step for a site whose next place and lead (momentum part of the step) are already known.
/// @pre `place` is on the coordinate lattice and in the container
Treated treat_place(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h,
                    geometry::Vec2 place, geometry::Vec2 lead, int pushes_allowed);

/// @brief Returns whether the site at p is deleted in this round. A hash of the place chooses SweepRules::deleted_share
/// of the sites that are marked for deletion. The other marked sites wait for a later round, because the room that a
/// deleted site leaves may be enough for its neighbours.
bool is_chosen(geometry::Vec2 p, int round);

/// @brief Moves all sites out of the diametral circles of the boundary edges, without an update rule. Sites in a circle
/// are pushed out; sites that have been pushed SweepRules::pushes_allowed times are deleted in rounds, until no site is
/// left in a circle. The result for one site does not depend on other inner sites, because the boundary edges stay.
/// Collective.
/// @param typical_size any typical target edge length, with which the searches for nearby boundary edges begin
/// @return false if all diametral circles were empty on all ranks before the call
bool settle_sites(sites::SiteState& state, const MoveContext& context, double typical_size);

} // namespace trime::sweep
