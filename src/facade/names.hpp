// SPDX-License-Identifier: BSD-3-Clause
// Finds the number of a name of the mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trime {

/// Returns the index of `name` in `names`, which are those of the boundary or of another kind.
/// @throws ConfigError on this rank alone if the name is unknown; the message lists the known names
std::int32_t number_of(const std::string& name, const std::vector<std::string>& names, const char* kind = "boundary");

} // namespace trime
