// SPDX-License-Identifier: BSD-3-Clause
// Reads the bytes of a file that a user has named, and tests what is at its path. Opening a pipe would wait without
// end, and a file that is renamed to the name of a device would take its place.
#pragma once

#include <cstdint>
#include <string>

namespace trime {

/// @brief Returns "a directory", "a named pipe", "a device" or "a socket"; links are followed. Returns an empty text
/// for a regular file and where nothing is found.
std::string irregular_kind(const std::string& path);

/// [bytes] Larger files are refused: a contour of 2^31 bytes has about 5 10^7 vertices, and every rank holds them.
inline constexpr std::int64_t most_bytes_of_a_file = std::int64_t{1} << 31;

/// @brief Returns the content of a regular file. Pipes and devices are refused, because they may have no end. Throws
/// FileError with the reason of the system if it cannot be opened or read (also for a directory), with `hint` at the
/// end if it cannot be opened. Throws FileError with its size if it has more bytes than `most`.
/// @note Serial: in a parallel run one rank reads and sends the text to the others.
std::string read_file(const std::string& path, const std::string& hint = "", std::int64_t most = most_bytes_of_a_file);

} // namespace trime
