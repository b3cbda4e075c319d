// SPDX-License-Identifier: BSD-3-Clause
// Keeps inner sites inside and out of the diametral discs of the boundary segments: push, and delete after three
// pushes.
#pragma once

#include "meshing/site_state.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/meshing/boundary_guard.hpp"
#include "trime/meshing/update_rule.hpp"

namespace trime::meshing {

/// What one round did on this rank.
struct MoveCounts {
  std::int64_t moving = 0; ///< moved by more than 0.005 h
  std::int64_t pushed = 0, deleted = 0;
  double max_move = 0; ///< longest move over h
  FixedSum power;      ///< of the moves, see SweepSums

  void add(const MoveCounts& other);
};

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
/// offender is pushed, or deleted once it has been pushed as often as is allowed.
Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int pushes_allowed);
constexpr int pushes_allowed = 3;

/// @brief One round without any rule: offenders are pushed, or deleted once they have been pushed three times or
/// `delete_all` is set. Collective. @return counts of this rank; pushed + deleted == 0 everywhere means that all discs
/// are empty
MoveCounts settle_round(SiteState& state, const MoveContext& context, bool delete_all);

} // namespace trime::meshing
