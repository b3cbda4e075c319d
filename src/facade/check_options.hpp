// SPDX-License-Identifier: BSD-3-Clause
// Whether the options of make_mesh make sense, and are the same on all ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/facade/mesh.hpp"

namespace trime {

/// @throws ConfigError on all ranks together: for values that no mesh can meet, and for ranks that ask for different
/// things @note Collective.
void check_options(const Shape& shape, const MeshOptions& options, const comm::Communicator& comm);

} // namespace trime
