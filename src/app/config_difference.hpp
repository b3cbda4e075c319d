// SPDX-License-Identifier: BSD-3-Clause
// Compares two configs, as far as the mesh depends on them.
#pragma once

#include <string>
#include <vector>

namespace trime::app {

/// @brief One line for each key that is not the same in two resolved configs: "points in [meshing]: 1000 then, 2000
/// now". Numbers are compared as numbers. Without keys that leave the mesh as it is: [parallel], [output],
/// [checkpoint], [log], and paths of files.
std::vector<std::string> differing_keys(const std::string& then, const std::string& now);

} // namespace trime::app
