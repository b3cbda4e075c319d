// SPDX-License-Identifier: BSD-3-Clause
// The canonical numbering of the mesh: points along the Hilbert curve, whatever ranks own them.
#pragma once

#include "decomposition/halo.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"

#include <vector>

namespace trime::decomposition {

/// @brief A vertex is a number of this rank alone: the owned points from 0 in canonical order, after them those of
/// other ranks by ascending global id. Images of a point are one vertex. 8 bytes per site.
struct Numbering {
  GlobalId first = 0;                  ///< global id of the first owned point in canonical order
  GlobalId total = 0;                  ///< points of the whole mesh
  UnsetVector<LocalIndex> order;       ///< owned local indices in canonical order, so by vertex
  UnsetVector<LocalIndex> site_vertex; ///< by local index, owned and ghosts
  std::vector<GlobalId> foreign;       ///< global ids of the vertices from order.size() on
  LocalIndex foreign_below = 0;        ///< how many of them come before the first owned point

  LocalIndex owned() const { return static_cast<LocalIndex>(order.size()); }
  /// Vertex of a site.
  LocalIndex vertex(LocalIndex site) const { return site_vertex[static_cast<std::size_t>(site)]; }
  GlobalId global_id(LocalIndex vertex) const {
    return vertex < owned() ? first + vertex : foreign[static_cast<std::size_t>(vertex - owned())];
  }
  /// A number that orders vertices as their global ids do; below 0 for those before the first owned point.
  LocalIndex place(LocalIndex vertex) const {
    return vertex >= owned() && vertex < owned() + foreign_below ? vertex - owned() - foreign_below : vertex;
  }
};

/// @brief Numbers the sites by the Hilbert key of their coordinates, ties lexicographic. Because ranks own ascending
/// ranges of the same curve, this is one scan and a sort inside each bin. @pre the halo of `points` is fresh.
/// O(sites), by all threads. Collective.
Numbering canonical_numbering(const comm::Communicator& comm, const mesh::BinnedPoints& points, const Halo& halo);

} // namespace trime::decomposition
