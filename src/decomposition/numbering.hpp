// SPDX-License-Identifier: BSD-3-Clause
// The canonical numbering of the mesh: points are numbered along the Hilbert curve, regardless of their owners.
#pragma once

#include "decomposition/halo.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"

#include <vector>

namespace trime::decomposition {

/// @brief Numbers of points. A *vertex* is a number that is local to this rank: the owned points come first, in
/// canonical order, then those of other ranks by ascending global id. All images of a point are one vertex. 8 bytes per
/// site.
struct Numbering {
  GlobalId first = 0;                  ///< global id of the first owned point in canonical order
  GlobalId total = 0;                  ///< points of the whole mesh
  UnsetVector<LocalIndex> order;       ///< local indices of the owned points by vertex, so in canonical order
  UnsetVector<LocalIndex> site_vertex; ///< vertex by local index, of owned sites and ghosts
  std::vector<GlobalId> foreign;       ///< global ids of the vertices from order.size() on
  LocalIndex foreign_below = 0;        ///< how many of them come before the first owned point

  LocalIndex owned() const { return static_cast<LocalIndex>(order.size()); }
  /// Returns the vertex of a site.
  LocalIndex vertex(LocalIndex site) const { return site_vertex[static_cast<std::size_t>(site)]; }
  GlobalId global_id(LocalIndex vertex) const {
    return vertex < owned() ? first + vertex : foreign[static_cast<std::size_t>(vertex - owned())];
  }
  /// Returns a number that orders vertices as their global ids do; negative for vertices before the first owned point.
  LocalIndex place(LocalIndex vertex) const {
    return vertex >= owned() && vertex < owned() + foreign_below ? vertex - owned() - foreign_below : vertex;
  }
};

/// @brief Numbers the sites by the Hilbert key of their coordinates, ties lexicographic. Because ranks own ascending
/// ranges of the same curve, this takes one scan over the ranks and a sort inside each bin. @pre the halo of `points`
/// is up to date. O(sites), by all threads. Collective.
Numbering canonical_numbering(const comm::Communicator& comm, const mesh::BinnedPoints& points, const Halo& halo);

} // namespace trime::decomposition
