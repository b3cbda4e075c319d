// SPDX-License-Identifier: BSD-3-Clause
// Boundary samples with their local feature sizes: the cones whose lower envelope is the automatic size field.
#pragma once

#include "cones/cone_tree.hpp"
#include "sizing/images.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"

#include <vector>

namespace trime::sizing {

/// @brief Cones (b, lfs(b)) with lfs at least `feature_floor`, so dense that the envelope is right to a few per cent;
/// those that others cover completely, at slope `gradation`, are left out; periodic images within reach included.
/// O(n log n) for n samples, shared by ranks and threads. Collective.
/// @pre feature_floor > 0, gradation > 0, the boundary has a piece
std::vector<cones::Cone> boundary_features(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                           const Images& images, double feature_floor, double gradation);

} // namespace trime::sizing
