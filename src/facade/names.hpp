// SPDX-License-Identifier: BSD-3-Clause
// The names of the boundary.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trime {

/// The number of a name. @throws ConfigError with the known names if it is none of them, on this rank alone
std::int32_t number_of(const std::string& name, const std::vector<std::string>& names);

} // namespace trime
