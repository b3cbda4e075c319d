// SPDX-License-Identifier: BSD-3-Clause
// From the shape of a program to its boundary on every rank.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/facade/mesh.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/shape/marked_boundary.hpp"

namespace trime {

struct BuiltShape {
  shape::MarkedBoundary made;
  geometry::Box container;
};

/// @brief Reads contours on rank 0, chooses the container as the program does, and makes the boundary.
/// @throws ConfigError, GeometryError, FileError on all ranks together @note Collective.
BuiltShape build_shape(const Shape& shape, const MeshOptions& options, const comm::Communicator& comm, Log& log);

} // namespace trime
