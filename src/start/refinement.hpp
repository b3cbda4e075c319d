// SPDX-License-Identifier: BSD-3-Clause
// Makes the inner sites of the next, finer stage from the relaxed sites of the present stage. Boundary sites are placed
// again.
#pragma once

#include "sites/fan.hpp"
#include "sites/stage.hpp"

#include <cstdint>
#include <vector>

namespace trime::start {

/// Returns whether a place lies inside the shape, outside of the strip along its boundary in which no site starts.
/// @throws GeometryError on this rank alone if the size there is not positive and finite
bool is_clear(const sites::Stage& next, geometry::Vec2 p);

/// Returns the owned inner sites without their leads (momentum).
mesh::SiteList inner_sites(const sites::SiteState& state);

/// @brief Returns the owned inner sites and the midpoints of inner edges, each edge once. Together they are four times
/// as many sites at half the spacing, and as regular as the coarse mesh.
/// @pre all stars are certain
mesh::SiteList split_edges(const sites::StageView& view);

/// @brief Adds sites at the centroids of the triangles whose circumradius is largest relative to h: `count` sites over
/// all ranks, or as many as there are triangles. Places in the strip along the new boundary are left out. Collective.
/// @pre all stars are certain
void insert_in_triangles(const sites::StageView& view, const sites::Stage& next, std::int64_t count,
                         mesh::SiteList& sites);

/// Removes sites that are outside of the shape or within 0.43 h of its boundary, for h and boundary of the next stage.
/// Collective.
void clear_strip(const sites::Stage& next, mesh::SiteList& sites);

/// @brief Removes sites until at most `most` are left over all ranks. The removed sites are those nearest to the
/// boundary relative to h; the mesh is irregular there in any case. Collective.
/// @return the number of removed sites
std::int64_t trim(const comm::Communicator& comm, const sites::Stage& next, std::int64_t most, mesh::SiteList& sites);

} // namespace trime::start
