// SPDX-License-Identifier: BSD-3-Clause
// Finds out what a run will do to the shape, without making a mesh.
#pragma once

#include "meshing/run_context.hpp"
#include "trime/meshing/mesher.hpp"

namespace trime::meshing {

/// See Mesher::outlook. Collective.
/// @throws ConfigError and GeometryError as the run would when it lays out its boundary
Outlook look_ahead(const RunContext& run, Advice advice);

} // namespace trime::meshing
