// SPDX-License-Identifier: BSD-3-Clause
// Samples the boundary and its local feature sizes. The lower envelope of the resulting cones is the automatic size
// field.
#pragma once

#include "cones/cone_tree.hpp"
#include "sizing/images.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"

#include <vector>

namespace trime::sizing {

/// @brief Returns cones (b, lfs(b)) with lfs at least `feature_floor`, so dense that the envelope has an error of a few
/// per cent. Leaves out cones that others cover completely at slope `gradation`, and includes periodic images within
/// reach. O(n log n) for n samples, shared among ranks and threads. Collective.
/// @pre feature_floor > 0, gradation > 0, the boundary has a piece
std::vector<cones::Cone> boundary_features(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                           const Images& images, double feature_floor, double gradation);

} // namespace trime::sizing
