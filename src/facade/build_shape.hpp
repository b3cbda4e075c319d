// SPDX-License-Identifier: BSD-3-Clause
// Makes the domain from a shape of trime.hpp, on every rank.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/facade/mesh.hpp"
#include "trime/geometry/boundary.hpp"

namespace trime {

/// @brief Reads contours on rank 0, chooses the container as trime_mpi does, and makes the boundary with its fixed
/// points.
/// @throws ConfigError, GeometryError, FileError on all ranks together @note Collective.
geometry::Domain build_domain(const Shape& shape, const MeshOptions& options, const comm::Communicator& comm, Log& log);

} // namespace trime
