// SPDX-License-Identifier: BSD-3-Clause
// Numbers the points of the mesh along the Hilbert curve, independently of the ranks that own them.
#pragma once

#include "decomposition/halo.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"

#include <vector>

namespace trime::decomposition {

/// @brief The local and the global numbers of the points that this rank knows. A *vertex* is a number that is local to
/// this rank: first the owned points in the order of their global ids, then points of other ranks by ascending global
/// id. All periodic images of a point have the same vertex. Memory: 8 bytes per site.
struct Numbering {
  GlobalId first = 0; ///< global id of the first owned point
  GlobalId total = 0; ///< number of points of the whole mesh
  UnsetVector<LocalIndex>
      order; ///< local indices of the owned points in the order of their vertices, which is that of their global ids
  UnsetVector<LocalIndex> site_vertex; ///< vertex of each owned site and ghost, by local index
  std::vector<GlobalId> foreign;       ///< global ids of the vertices from order.size() on
  LocalIndex foreign_below = 0;        ///< number of vertices in `foreign` whose global id is below `first`

  LocalIndex owned() const { return static_cast<LocalIndex>(order.size()); }
  /// Returns the vertex of a site.
  LocalIndex vertex(LocalIndex site) const { return site_vertex[static_cast<std::size_t>(site)]; }
  GlobalId global_id(LocalIndex vertex) const {
    return vertex < owned() ? first + vertex : foreign[static_cast<std::size_t>(vertex - owned())];
  }
  /// Returns a number that orders vertices in the same way as their global ids; negative for vertices before the first
  /// owned point.
  LocalIndex place(LocalIndex vertex) const {
    return vertex >= owned() && vertex < owned() + foreign_below ? vertex - owned() - foreign_below : vertex;
  }
};

/// @brief Numbers the sites by the Hilbert key of their coordinates; sites with equal keys are ordered
/// lexicographically. Because ranks own ascending ranges of the same curve, this takes one scan over the ranks and a
/// sort inside each bin. Cost: O(sites), by all threads. Collective.
/// @pre the halo of `points` is up to date
Numbering canonical_numbering(const comm::Communicator& comm, const mesh::BinnedPoints& points, const Halo& halo);

} // namespace trime::decomposition
