// SPDX-License-Identifier: BSD-3-Clause
// Finds out what lies at a path where a file is expected. Opening a pipe would wait without end, and a file that is
// renamed to the name of a device would take its place.
#pragma once

#include <string>

namespace trime {

/// @brief Returns "a directory", "a named pipe", "a device" or "a socket"; links are followed. Returns an empty text
/// for a regular file and where nothing is found.
std::string irregular_kind(const std::string& path);

} // namespace trime
