// SPDX-License-Identifier: BSD-3-Clause
// Keeps inner sites inside the shape, and out of the diametral discs of the chords. Sites in a disc are pushed out of
// it; sites that have been pushed too often are deleted.
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

/// The result for one site: its next place, and whether it was pushed or must be deleted.
struct Treated {
  geometry::Vec2 position, lead;
  std::int32_t pushes = 0; ///< all pushes of the site so far
  bool pushed = false, deleted = false;
};

/// @brief Returns the place to which a step of a rule moves a site. The step is cut to SweepRules::move_cap (the lead
/// is shortened first) and snapped to the lattice. A site that would enter a disc is pushed out of it. A site that has
/// been pushed `pushes_allowed` times is marked for deletion; until it is deleted, it moves as a push would move it.
Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int pushes_allowed);
/// As treat_step, for a site that would move to this place with this lead. @pre `place` is on the lattice and in the
/// container
Treated treat_place(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h,
                    geometry::Vec2 place, geometry::Vec2 lead, int pushes_allowed);

/// @brief Returns whether the site at p is deleted in this round. Each round chooses SweepRules::deleted_share of the
/// sites marked for deletion, by a hash of the place. In a crowd, the room that one site leaves may be enough for the
/// others.
bool is_chosen(geometry::Vec2 p, int round);

/// @brief Moves all sites out of the discs of chords, without a rule. Sites in a disc are pushed; those that have been
/// pushed SweepRules::pushes_allowed times are deleted in rounds, until all are gone. Sites do not depend on each
/// other, because the chords stay. Collective.
/// @param typical_size any typical h, with which searches begin
/// @return false if all discs were empty on all ranks before
bool settle_sites(sites::SiteState& state, const MoveContext& context, double typical_size);

} // namespace trime::sweep
