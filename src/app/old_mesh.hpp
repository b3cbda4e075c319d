// SPDX-License-Identifier: BSD-3-Clause
// Reads the points of the mesh file from which a run starts.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"
#include "trime/meshing/mesher.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace trime::app {

/// The points of a mesh file.
struct OldMesh {
  std::string file;
  UnsetVector<geometry::Vec2> places; ///< an equal share on each rank
  geometry::Vec2 periods{};
  GlobalId count = 0;     ///< number of points over all ranks
  std::uint64_t hash = 0; ///< hash of the places of the points, in any order

  /// Returns what the mesher needs. @pre this object outlives the result
  meshing::OldPoints points() const { return {places, periods, file}; }
};

/// @brief Reads a mesh file. Memory: that of the mesh while it is read, then that of its points.
/// @throws ConfigError on all ranks if the file is missing, damaged, or no mesh file
/// @note Collective.
OldMesh read_old_mesh(const std::string& path, const comm::Communicator& comm);

/// Returns a section with the hash of the points for the config in a checkpoint, so that a restart with another mesh is
/// refused; empty without an old mesh.
std::string hash_of(const std::optional<OldMesh>& old);

} // namespace trime::app
