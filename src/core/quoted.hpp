// SPDX-License-Identifier: BSD-3-Clause
// Quotes in messages what users wrote, shortened: a line of a megabyte helps nobody.
#pragma once

#include <string>
#include <string_view>

namespace trime {

/// The text, cut after 60 bytes and then with "..."; bytes that could upset a terminal become '?'.
std::string shown(std::string_view text);

/// Returns the shortened text between single quotes.
std::string quoted(std::string_view text);

/// A message whose length nobody has seen to: the middle is left out of one that has more bytes, by default five lines.
std::string without_middle(const std::string& message, std::size_t longest = 600);

} // namespace trime
