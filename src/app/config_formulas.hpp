// SPDX-License-Identifier: BSD-3-Clause
// Reads the formulas of a config that may use data, and the sections [field.NAME] with the data.
#pragma once

#include "app/ini.hpp"
#include "app/options.hpp"
#include "app/settings.hpp"

#include <filesystem>

namespace trime::app {

/// Fills `options.fields`, the formula of the size, and that of the depth. A field that no formula uses gives a
/// warning, and is not read.
/// @param directory that of the config file
void read_formulas(const Settings& settings, const std::filesystem::path& directory, RunOptions& options,
                   Diagnostics& problems);

} // namespace trime::app
