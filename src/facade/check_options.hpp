// SPDX-License-Identifier: BSD-3-Clause
// Checks that the options of make_mesh make sense and are the same on all ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/facade/mesh.hpp"

namespace trime {

/// @throws ConfigError on all ranks together, if no mesh can meet a value or if ranks have different options @note
/// Collective.
void check_options(const Shape& shape, const MeshOptions& options, const comm::Communicator& comm);

} // namespace trime
