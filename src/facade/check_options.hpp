// SPDX-License-Identifier: BSD-3-Clause
// Checks that the options of make_mesh are valid and the same on all ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/facade/mesh.hpp"

namespace trime {

/// Checks the options, and whether they suit the size.
/// @throws ConfigError on all ranks together, if no mesh can satisfy an option or if ranks have different options
/// @note Collective.
void check_options(const Shape& shape, const Size& size, const MeshOptions& options, const comm::Communicator& comm);

} // namespace trime
