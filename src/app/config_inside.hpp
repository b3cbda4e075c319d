// SPDX-License-Identifier: BSD-3-Clause
// Reads the sections of a config that describe what lies inside a shape: [region.NAME] and [curve.NAME].
#pragma once

#include "app/ini.hpp"
#include "app/options.hpp"
#include "app/settings.hpp"

#include <filesystem>
#include <set>

namespace trime::app {

/// @brief Sets RunOptions::regions and curves, and `rest` and `cover` of [shape].
/// @param directory that of the config file
/// @return the parts that occur in expressions of regions, as indices into Settings::parts
/// @pre the parts and the geometry are read
std::set<int> read_inside(const Settings& settings, const std::filesystem::path& directory, RunOptions& options,
                          Diagnostics& problems);

} // namespace trime::app
