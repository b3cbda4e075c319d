// SPDX-License-Identifier: BSD-3-Clause
// Reads a mesh file: distributes the arrays over the ranks, and gives the metadata to all of them.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <string>
#include <vector>

namespace trime::io {

/// @brief Reads the group /trime_mpi of a mesh file. Leaves out attributes of other types than those of Attribute.
/// @param groups names of the groups to read, if the file has them: some are as long as the number of ranks
/// @throws FileError on all ranks if this is not a mesh file
/// @note Collective. Rank 0 reads.
Metadata read_metadata(const std::string& path, const std::vector<std::string>& groups, const comm::Communicator& comm);

/// @brief Reads the mesh of a file: equal slabs of points, triangles and facets for each rank, whichever ranks wrote
/// it. Computes its hash and compares it. Memory: the mesh.
/// @param metadata metadata of this file
/// @throws FileError on all ranks if an array is missing or short, an id is out of range, or the hash is not that of
/// the metadata
/// @note Collective.
mesh::DistributedMesh read_mesh(const std::string& path, const Metadata& metadata, const comm::Communicator& comm);

} // namespace trime::io
