// SPDX-License-Identifier: BSD-3-Clause
// Keeps inner sites inside the shape, and out of the diametral discs of the chords. Sites in a disc are pushed out of
// it; sites that have been pushed too often are deleted.
#pragma once

#include "polygon/boundary_guard.hpp"
#include "sites/stage.hpp"
#include "sweep/update_rule.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::sweep {

/// The data that decide where a site may go.
struct MoveContext {
  const polygon::BoundaryGuard& guard;
  const sizing::SizeField& size;
  const geometry::Lattice& lattice;
};

inline MoveContext move_context(const sites::Stage& stage, const geometry::Lattice& lattice) {
  return {*stage.guard, *stage.size, lattice};
}

/// The treatment of a site: where it goes, and whether it was pushed or must be deleted.
struct Treated {
  geometry::Vec2 position, lead;
  std::int32_t pushes = 0; ///< those before included
  bool pushed = false, deleted = false;
};

/// @brief The place that a step of a rule leads to. The step is cut to SweepRules::move_cap (the lead gives way first)
/// and snapped to the lattice. A site that would come into a disc is pushed out of it. Once it has been pushed as often
/// as is allowed, it is to be deleted, and goes where a push would take it until that happens.
Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int pushes_allowed);
/// Does the same for a site that would go to this place, on the lattice and in the container, with this lead.
Treated treat_place(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h,
                    geometry::Vec2 place, geometry::Vec2 lead, int pushes_allowed);

/// @brief Is it the turn of the site at p to be deleted? SweepRules::deleted_share of all are chosen in each round, by
/// a hash of the place. Where sites are crowded, the room that one leaves may be enough for the others.
bool is_chosen(geometry::Vec2 p, int round);

/// @brief Empties the discs of all chords where no rule moves sites. Sites in a disc are pushed; those that have been
/// pushed SweepRules::pushes_allowed times are deleted when it is their turn, in the end all of them. Every site is
/// treated by itself, since the chords stay. Collective.
/// @param typical_size any typical h: where searches begin
/// @return false if there was no offender on any rank: all discs were empty
bool settle_sites(sites::SiteState& state, const MoveContext& context, double typical_size);

} // namespace trime::sweep
