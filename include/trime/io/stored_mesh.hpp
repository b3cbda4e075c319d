// SPDX-License-Identifier: BSD-3-Clause
// A mesh file, read back: the arrays shared out over the ranks, the metadata on all of them.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <string>
#include <vector>

namespace trime::io {

/// @brief The group /trime_mpi of a mesh file. Attributes of other types than those of Attribute are left out.
/// @param groups of its groups those that are read, where the file has them: some are as long as the number of ranks
/// @throws FileError on all ranks if this is no mesh file
/// @note Collective. Rank 0 reads.
Metadata read_metadata(const std::string& path, const std::vector<std::string>& groups, const comm::Communicator& comm);

/// @brief The mesh of a file: equal slabs of points, triangles and facets for each rank, whoever wrote it. Its hash is
/// computed anew. Memory: the mesh.
/// @param metadata of the same file
/// @throws FileError on all ranks if an array is missing or short, an id is out of range, or the hash is not that of
/// the metadata
/// @note Collective.
mesh::DistributedMesh read_mesh(const std::string& path, const Metadata& metadata, const comm::Communicator& comm);

} // namespace trime::io
