// SPDX-License-Identifier: BSD-3-Clause
// From the text of a config file and the overrides of the command line to the options of a run.
#pragma once

#include "app/options.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::app {

/// @brief Understands a config. Pure: the same text gives the same options on every rank.
/// @param path as the user gave it: names the file in messages, gives the default of output.name, and paths in the
/// config are relative to its directory
/// @param overrides `section.key=value` each
/// @throws ConfigError with one line per mistake, all mistakes at once
RunOptions parse_config(std::string_view text, const std::string& path, const std::vector<std::string>& overrides);

/// "distmesh", "cvd", "hybrid".
std::string method_name(sweep::Method method);

} // namespace trime::app
