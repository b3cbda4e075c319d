// SPDX-License-Identifier: BSD-3-Clause
// Looks up names of the boundary.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trime {

/// Returns the number of a name. @throws ConfigError on this rank alone, with the known names, if the name is not known
std::int32_t number_of(const std::string& name, const std::vector<std::string>& names);

} // namespace trime
