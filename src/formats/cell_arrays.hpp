// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cells of a mesh as arrays of its HDF5 file. src/files.md describes them.
#pragma once

#include "io/extra_arrays.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <cstddef>

namespace trime::formats {

/// @brief Returns the group of the file with polygons, areas, centroids and faces of all cells. The rows are made while
/// they are written; memory: 160 bytes per point. The arrays do not depend on the number of ranks.
/// @param period of the container; 0 in a direction in which it is not periodic
/// @pre the mesh outlives the group, and has triangles
/// @throws FileError on all ranks if the triangles around a point are not one fan
/// @note Collective.
io::ExtraGroup cell_arrays(const mesh::DistributedMesh& mesh, geometry::Vec2 period, const comm::Communicator& comm);

/// @brief Returns the checks of the cells, see dual::prove. The cells of a refined mesh need not pass.
/// @param regions number of regions
/// @note Collective.
mesh::Checks cell_checks(const mesh::DistributedMesh& mesh, geometry::Vec2 period, std::size_t regions,
                         const comm::Communicator& comm);

} // namespace trime::formats
