// SPDX-License-Identifier: BSD-3-Clause
// Shortens and quotes text of users for messages: a line of a megabyte helps nobody.
#pragma once

#include <string>
#include <string_view>

namespace trime {

/// Returns at most 60 bytes of the text, with "..." behind if it is longer. Bytes that could upset a terminal become
/// '?'.
std::string shown(std::string_view text);

/// Returns the shortened text between single quotes.
std::string quoted(std::string_view text);

/// Returns the message without its middle if it is longer than `longest` bytes; the default is about five lines.
std::string without_middle(const std::string& message, std::size_t longest = 600);

} // namespace trime
