// SPDX-License-Identifier: BSD-3-Clause
// Inner sites for the next, finer stage from the relaxed sites of this one. Boundary sites are laid out again.
#pragma once

#include "sites/fan.hpp"
#include "sites/stage.hpp"

#include <cstdint>
#include <vector>

namespace trime::start {

/// The owned inner sites, at rest.
mesh::SiteList inner_sites(const sites::SiteState& state);

/// @brief The owned inner sites and the middles of inner edges, each edge from one of its ends: four times as many
/// sites, at half the spacing, in the order that the coarse sites have found. @pre all stars are certain
mesh::SiteList split_edges(const sites::StageView& view);

/// @brief Adds sites in the middles of triangles, where the circumradius is largest relative to h there: `count` over
/// all ranks, or as many triangles as there are. Only places outside the strip along the new boundary count.
/// Collective. @pre all stars are certain
void insert_in_triangles(const sites::StageView& view, const sites::Stage& next, std::int64_t count,
                         mesh::SiteList& sites);

/// Removes sites outside of the shape or within 0.43 h of its boundary, as the next stage has it. Collective.
void clear_strip(const sites::Stage& next, mesh::SiteList& sites);

/// @brief Removes sites until at most `most` are left over all ranks: those nearest to the boundary relative to h,
/// where the order is disturbed anyway. Collective. @return number removed
std::int64_t trim(const comm::Communicator& comm, const sites::Stage& next, std::int64_t most, mesh::SiteList& sites);

} // namespace trime::start
