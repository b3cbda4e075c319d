// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a file that a user has named.
#pragma once

#include <string>

namespace trime {

/// @brief The whole file. @throws FileError with the system's reason if it cannot be opened or read (a directory, too);
/// `hint` ends the message if it cannot be opened
/// @note Serial: in a parallel run one rank reads and sends the text to the others.
std::string read_file(const std::string& path, const std::string& hint = "");

} // namespace trime
