// SPDX-License-Identifier: BSD-3-Clause
// Reads the section [sizing] of a config.
#pragma once

#include "app/ini.hpp"
#include "app/options.hpp"
#include "app/settings.hpp"

namespace trime::app {

/// Fills `options.sizing`, except for the formula, and the bounds of the size. A key without effect gives a warning.
/// @pre `sizing.uses_data` is set
void read_sizing(const Settings& settings, RunOptions& options, Diagnostics& problems);

} // namespace trime::app
