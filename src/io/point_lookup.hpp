// SPDX-License-Identifier: BSD-3-Clause
// Finds positions and sizes of points of a distributed mesh by their global ids, on any rank.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <vector>

namespace trime::io {

/// The position of a point, and the target edge length and the depth there.
struct MeshPoint {
  geometry::Vec2 position;
  double size = 0;
  double depth = 0; ///< 0 if the mesh has no depths
};

/// @brief Fetches points from the ranks that hold them, and stores them. Memory: 40 bytes per different id.
class PointLookup {
public:
  /// @param wanted global ids of points of the mesh, in any order, possibly repeated
  /// @note Collective; two sparse exchanges.
  PointLookup(const mesh::DistributedMesh& mesh, std::vector<GlobalId> wanted, const comm::Communicator& comm);

  /// Returns the point with this id. Cost: O(log ids).
  /// @pre `id` was among the wanted ids
  const MeshPoint& operator[](GlobalId id) const;

private:
  std::vector<comm::Message> questions(const std::vector<std::int64_t>& firsts) const;

  std::vector<GlobalId> ids_;
  std::vector<MeshPoint> points_;
};

} // namespace trime::io
