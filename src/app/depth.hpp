// SPDX-License-Identifier: BSD-3-Clause
// Gives a mesh the depths that the formula of [output] asks for.
#pragma once

#include "core/distance_formula.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/io/metadata.hpp"
#include "trime/meshing/options.hpp"

#include <cmath>
#include <cstdint>
#include <span>

namespace trime::app {

/// The depths of the points of a mesh.
struct DepthSummary {
  std::int64_t points = 0;                 ///< all of them
  std::int64_t numbers = 0;                ///< points whose depth is a number
  std::int64_t positive = 0, negative = 0; ///< among these
  double least = INFINITY, most = -INFINITY;
  geometry::Vec2 first_without; ///< the first point whose depth is not a number, if there is one
};

/// @brief Sets the depth of all points of the mesh, and adds a check that all depths are numbers, which may fail.
/// Prints their range, and warns if most of them are not positive, since their sign is probably wrong then. Collective.
/// Cost: one evaluation per point, by all threads.
DepthSummary add_depth(const DistanceFormula& formula, meshing::MeshResult& result, const comm::Communicator& comm,
                       Log& log);

/// Returns the summary as a group of the mesh file.
io::MetadataGroup group_of(const DepthSummary& summary);

/// Prints the warnings of add_depth() for some places of the shape, before a mesh is made. Serial.
void try_depth(const DistanceFormula& formula, std::span<const geometry::Vec2> places, Log& log);

} // namespace trime::app
