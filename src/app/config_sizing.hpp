// SPDX-License-Identifier: BSD-3-Clause
// Reads the section [sizing] of a config.
#pragma once

#include "app/ini.hpp"
#include "app/options.hpp"
#include "app/settings.hpp"

#include <filesystem>

namespace trime::app {

/// Fills `options.sizing` and the bounds of the size. A key without effect gives a warning.
/// @param directory that of the config file
void read_sizing(const Settings& settings, const std::filesystem::path& directory, RunOptions& options,
                 Diagnostics& problems);

} // namespace trime::app
