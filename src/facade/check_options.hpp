// SPDX-License-Identifier: BSD-3-Clause
// Checks that the options of make_mesh are valid and the same on all ranks.
#pragma once

#include "acceptance/solver_rules.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/facade/mesh.hpp"

#include <string>
#include <vector>

namespace trime {

/// Checks the options, the names of several sizes, and whether the options suit the size. Functions of different ranks
/// cannot be compared.
/// @throws ConfigError on all ranks together, if no mesh can satisfy an option, or if ranks have different options or
/// sizes
/// @note Collective.
void check_options(const Shape& shape, const Size& size, const MeshOptions& options, const comm::Communicator& comm);

/// Returns the models whose names MeshOptions::accept has.
/// @throws ConfigError for an unknown name; the message lists the known names
std::vector<acceptance::Solver> models_of(const std::vector<std::string>& words);

} // namespace trime
