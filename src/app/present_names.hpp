// SPDX-License-Identifier: BSD-3-Clause
// Accepts keys and values under the names of earlier versions, which old configs may have.
#pragma once

#include "app/ini.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::app {

/// @brief Reads the text of a config and the overrides, and replaces old names of keys and values by their present
/// names.
/// @param warnings receives a sentence for each old name
IniDocument read_document(std::string_view text, const std::vector<std::string>& overrides, Diagnostics& problems,
                          std::vector<std::string>& warnings);

} // namespace trime::app
