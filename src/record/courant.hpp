// SPDX-License-Identifier: BSD-3-Clause
// Says how a time step of a coastal model suits the mesh.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <cstdint>
#include <string>

namespace trime::record {

/// The time step of a model, and the Courant number that it should not exceed.
struct CourantOptions {
  double time_step = 0; ///< [s]; 0: no report
  double limit = 1;
};

/// The Courant numbers of the triangles of a mesh.
struct CourantSummary {
  CourantOptions options;
  std::int64_t triangles = 0, above = 0; ///< all, and those above the limit
  std::int64_t dry = 0; ///< triangles without a number, since the mean depth of their corners is not positive
  double largest = 0;   ///< 0 if all triangles are dry
  geometry::Vec2 place; ///< centre of the triangle with the largest number; (0, 0) if all are dry
};

/// @brief Returns the Courant numbers of gravity waves, time_step sqrt(g depth) / shortest edge, with the mean depth of
/// the corners. Triangles where this depth is not positive are dry and have no number. Lengths are in metres. Does not
/// depend on the number of ranks. Cost: O(triangles). Collective.
/// @pre the mesh has depths
CourantSummary courant_numbers(const CourantOptions& options, const mesh::DistributedMesh& mesh,
                               const comm::Communicator& comm);

/// Returns the summary in one line, for a message of Log.
std::string text_of(const CourantSummary& summary);

/// Returns the summary as a group of the mesh file.
io::MetadataGroup group_of(const CourantSummary& summary);

} // namespace trime::record
