// SPDX-License-Identifier: BSD-3-Clause
// Joins a mesh along its split curves.
#pragma once

#include "mesh.hpp"
#include "stored_file.hpp"

#include <cstdint>
#include <vector>

namespace trime_check {

/// Returns for each point the lowest of the points with which the pairs of the mesh join it.
std::vector<std::int64_t> lowest_copies(const Mesh& mesh);

/// @brief Returns the mesh as it was before its curves were split: one point for all copies of a point, the sides of
/// split curves as edges on curves, and as interfaces where regions differ. Ids keep their order. The arrays for other
/// readers and the list of all labelled edges are left out. @pre the ids of the mesh are in range
Mesh joined_mesh(const StoredFile& file, const Mesh& mesh);

} // namespace trime_check
