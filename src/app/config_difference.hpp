// SPDX-License-Identifier: BSD-3-Clause
// Compares the keys of two configs on which the mesh depends.
#pragma once

#include <string>
#include <vector>

namespace trime::app {

/// @brief Returns one line for each key with different values in two complete configs: "points in [meshing]: 1000 then,
/// 2000 now". Numbers are compared as numbers. Keys that do not change the mesh are left out: [parallel], [output],
/// [checkpoint], [log], and paths of files.
std::vector<std::string> differing_keys(const std::string& then, const std::string& now);

} // namespace trime::app
