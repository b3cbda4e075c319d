// SPDX-License-Identifier: BSD-3-Clause
// How far the boundary of a mesh runs from the boundary of its shape.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/shape.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/validity.hpp"

namespace trime::app {

/// @brief Two checks: boundary vertices lie on the shape's boundary; the middles of boundary edges stay near to it.
/// Both as the largest distance over h there. O(facets log pieces). @note Collective.
mesh::Checks check_boundary_distance(const mesh::DistributedMesh& mesh, const geometry::RegionShape& shape,
                                     const comm::Communicator& comm);

} // namespace trime::app
