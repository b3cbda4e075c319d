// SPDX-License-Identifier: BSD-3-Clause
// Converts texts to values. A text with anything before or after the value is refused.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace trime::app {

/// Reads a finite number. The function accepts "1e3", "+2" and ".5", and refuses "1,5", "nan", "inf" and "3x".
std::optional<double> parse_number(std::string_view text);
/// Reads an integer of at most 2^53 in magnitude; the form "1e6" is allowed.
std::optional<std::int64_t> parse_integer(std::string_view text);
/// Reads "true" or "false".
std::optional<bool> parse_boolean(std::string_view text);
/// Reads two numbers separated by blanks.
std::optional<geometry::Vec2> parse_pair(std::string_view text);

} // namespace trime::app
