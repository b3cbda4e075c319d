// SPDX-License-Identifier: BSD-3-Clause
// Keeps inner sites inside and out of the diametral discs of the boundary segments: push, and delete after three
// pushes.
#pragma once

#include "meshing/boundary_guard.hpp"
#include "meshing/site_state.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/meshing/update_rule.hpp"

namespace trime::meshing {

/// What a round of moves needs to know.
struct MoveContext {
  const BoundaryGuard& guard;
  const sizing::SizeField& size;
  const geometry::Lattice& lattice;
};

/// Where a site goes in the end.
struct Treated {
  geometry::Vec2 position, lead;
  std::int32_t pushes = 0; ///< those before included
  bool pushed = false, deleted = false;
};

/// @brief The step of a rule, capped at 0.4 h (the lead gives way first), snapped, kept inside and out of the discs: an
/// offender is pushed; once it has been pushed as often as is allowed it is to be deleted, and goes where a push would
/// take it until that happens.
Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int pushes_allowed);
/// What becomes of a site that would go to this place, on the lattice and in the container, with this lead.
Treated treat_place(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h,
                    geometry::Vec2 place, geometry::Vec2 lead, int pushes_allowed);
constexpr int pushes_allowed = 3;

/// @brief Is it the turn of the site at p to be deleted? One in three is chosen in each round, by a hash of its place:
/// where sites are crowded, room that one leaves may be enough for the others.
bool is_chosen(geometry::Vec2 p, int round);

/// @brief Empties the discs of all boundary segments where no rule moves sites: offenders are pushed; once they have
/// been pushed three times, and are still or again in a disc, they are deleted when it is their turn, in the end all of
/// them. Every site by itself, since segments stay. Collective.
/// @param typical_size any typical h: where searches begin
/// @return false if there was no offender on any rank: all discs were empty
bool settle_sites(SiteState& state, const MoveContext& context, double typical_size);

} // namespace trime::meshing
