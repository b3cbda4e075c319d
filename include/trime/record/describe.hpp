// SPDX-License-Identifier: BSD-3-Clause
// This header describes a mesh for its file: names and markers of the boundary, periods, loops, quality, checks and
// history.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/meshing/options.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::shape {
class RegionShape;
}

namespace trime::record {

/// Holds the names and markers that a mesh takes from its shape.
struct Origin {
  std::vector<std::string> part_names{};    ///< by DistributedMesh::facet_parts
  std::vector<std::int32_t> part_markers{}; ///< for each of these; 0: none
  std::string region{};                     ///< name of region 1: the expression that joins the parts
  geometry::Vec2 period{0, 0};              ///< sides of a periodic container, 0 where it is not periodic
  std::string crs{};                        ///< reference system of the coordinates; empty: none is known
  std::vector<std::int32_t> ring_lines{};   ///< for each loop of the shape its line in a file; shorter: 0 for the rest
};

/// The least and the largest h at a point of the mesh.
struct SizeRange {
  double smallest = 0, largest = 0;
};
/// Finds them on all ranks. O(points here). @note Collective.
SizeRange size_range(const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// The origin of a mesh of this shape.
Origin origin_of(const shape::RegionShape& shape);

/// @brief The metadata that io::write_mesh takes: the file is one that `trime_mpi info`, `trime_mpi convert` and
/// `trime_check` accept. O(points here + loops + sweeps).
/// @param sizing describes the size; "uniform" for a uniform one, which `trime_check` checks more closely
/// @note Collective.
io::Metadata describe(const meshing::MeshResult& result, const Origin& origin, const std::string& sizing,
                      const comm::Communicator& comm);

} // namespace trime::record
