// SPDX-License-Identifier: BSD-3-Clause
// Turns the text of a config file and the overrides of the command line into the options of a run.
#pragma once

#include "app/options.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::app {

/// @brief Reads a config. The same config gives the same options on every rank.
/// @param path the path as the user gave it. Messages name the file by this path, and the default of output.name is
/// made from it. Paths in the config are relative to its directory
/// @param overrides the overrides of the command line, each `section.key=value`
/// @throws ConfigError that lists all mistakes, one line per mistake
RunOptions parse_config(std::string_view text, const std::string& path, const std::vector<std::string>& overrides);

/// Returns the word for a method in a config: "distmesh", "cvd" or "hybrid".
std::string method_name(sweep::Method method);

} // namespace trime::app
