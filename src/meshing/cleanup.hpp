// SPDX-License-Identifier: BSD-3-Clause
// The tail of the quality: moves single sites where the worst triangles are, after all sweeps.
#pragma once

#include "meshing/layout.hpp"

#include <cstdint>
#include <span>

namespace trime::meshing {

/// @brief Place near `from` at which the largest alpha of the triangles (place, ring[k], ring[k+1]) is smallest, by a
/// search in eight directions with steps from 0.1 h down to 0.004 h. A pure function. @return `from` if none is better
geometry::Vec2 max_min_place(geometry::Vec2 from, std::span<const geometry::Vec2> ring, double h);

/// What a round did, over all ranks.
struct CleanupCounts {
  std::int64_t candidates = 0, moved = 0;
};

/// @brief One round: of the inner sites with a triangle above `worst_alpha` those move that have the least hash of
/// place and round among such neighbours, each to the place where its own worst triangle is best (Freitag and
/// Ollivier-Gooch 1997); nobody moves into the disc of a boundary segment. Independent sets by a hash are the same for
/// any partition, and nobody can block a ring for ever, as a choice by quality would. Stars are to be computed anew
/// afterwards. Collective. @pre stars of the inner sites are certain
CleanupCounts cleanup_round(const comm::Communicator& comm, Layout& layout, const geometry::Lattice& lattice,
                            double worst_alpha, int round);

} // namespace trime::meshing
