// SPDX-License-Identifier: BSD-3-Clause
// The shortest way from a shape and a size field of one's own to a mesh.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/meshing/options.hpp"
#include "trime/shape/region_shape.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::meshing {

/// @brief Meshes a shape that is made of parts. `shape` and `size` must give the same bits on every rank.
/// @throws ConfigError, GeometryError on all ranks together, see Mesher::run
/// @note Collective.
MeshResult make_mesh(const comm::Communicator& comm, const shape::RegionShape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// @brief Meshes a shape that is given by a function: traces it in options.container first. For periodic sides, trace
/// it yourself in a Frame that has them (shape::traced), and hand in what comes out.
/// @throws GeometryError on all ranks together, see shape::traced_part; for an exception of the shape's own, on any
/// rank, an Error with its message on all ranks. Else as above
/// @note Collective.
MeshResult make_mesh(const comm::Communicator& comm, const shape::Shape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// True if the stop rule was met and every check passed.
bool is_complete(const MeshResult& result);

} // namespace trime::meshing
