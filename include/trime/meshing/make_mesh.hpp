// SPDX-License-Identifier: BSD-3-Clause
// The shortest way from your own shape and size field to a mesh.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/domain.hpp"
#include "trime/meshing/options.hpp"
#include "trime/shape/region_shape.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::meshing {

/// @brief Makes a mesh of a domain. `domain` and `size` must give the same bits on every rank.
/// @throws ConfigError, GeometryError on all ranks together, see Mesher::run
/// @note Collective.
MeshResult make_mesh(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// Makes a mesh of the domain of a shape. Collective.
MeshResult make_mesh(const comm::Communicator& comm, const shape::RegionShape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// @brief Makes the domain where a function is negative, by tracing it in the container of `frame`.
/// @throws GeometryError on all ranks together, see shape::traced_part; if the shape throws on any rank, an Error with
/// its message on all ranks
/// @note Collective.
geometry::Domain traced_domain(const comm::Communicator& comm, const tracing::Shape& shape,
                               const geometry::Frame& frame);

/// Returns true if the stop rule was met and every check passed.
bool is_complete(const MeshResult& result);

} // namespace trime::meshing
