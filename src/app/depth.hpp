// SPDX-License-Identifier: BSD-3-Clause
// Gives a mesh the depths that the formula of [output] asks for.
#pragma once

#include "core/distance_formula.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/meshing/options.hpp"

namespace trime::app {

/// @brief Sets the depth of all points of the mesh, and adds a check that all depths are numbers, which may fail.
/// Prints their range. Collective. Cost: one evaluation per point, by all threads.
void add_depth(const DistanceFormula& formula, meshing::MeshResult& result, const comm::Communicator& comm, Log& log);

} // namespace trime::app
