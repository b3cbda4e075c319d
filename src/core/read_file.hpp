// SPDX-License-Identifier: BSD-3-Clause
// Reads the bytes of a file that a user has named, and tests what kind of file a path names. Opening a pipe would wait
// without end, and renaming a file to the name of a device would replace the device.
#pragma once

#include <cstdint>
#include <string>

namespace trime {

/// @brief Returns "a directory", "a named pipe", "a device" or "a socket"; links are followed. Returns an empty text if
/// the path names a regular file, or nothing.
std::string irregular_kind(const std::string& path);

/// [bytes] Larger files are refused. A contour of this size has about 5 10^7 vertices, which every rank holds.
inline constexpr std::int64_t most_bytes_of_a_file = std::int64_t{1} << 31;

/// @brief Returns the content of a regular file.
/// @throws FileError with the system's reason if the file cannot be opened or read (also for a directory); if it cannot
/// be opened, the message ends with `hint`. Pipes and devices are refused, because they may have no end. A file with
/// more than `most` bytes is refused with its size
/// @note Serial: in a parallel run one rank reads the file and sends its content to the others.
std::string read_file(const std::string& path, const std::string& hint = "", std::int64_t most = most_bytes_of_a_file);

} // namespace trime
