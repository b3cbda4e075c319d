// SPDX-License-Identifier: BSD-3-Clause
// Keys and values of earlier versions, which configs may still have.
#pragma once

#include "app/ini.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::app {

/// @brief Reads the text of a config and the overrides. Keys and values with an old name get their present one.
/// @param warnings gets a sentence for each old key
IniDocument read_document(std::string_view text, const std::vector<std::string>& overrides, Diagnostics& problems,
                          std::vector<std::string>& warnings);

} // namespace trime::app
