// SPDX-License-Identifier: BSD-3-Clause
// Finds the curves that the boundary of a mesh follows, without making the mesh.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/meshing/options.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::meshing {

/// @brief Returns the curves on which a run with this input places the points of its boundary: those of the shape, or
/// of the simplified shape without dropped loops. Does the work of a run up to its first sweep.
/// @throws ConfigError and GeometryError as the run would when it lays out its boundary
/// @note Collective.
geometry::Boundary meshed_curves(const comm::Communicator& comm, const geometry::Domain& domain,
                                 const sizing::SizeField& size, const MeshOptions& options);

} // namespace trime::meshing
