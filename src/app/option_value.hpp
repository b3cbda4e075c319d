// SPDX-License-Identifier: BSD-3-Clause
// Values as texts: strict conversions that take a whole text or nothing.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace trime::app {

/// A finite number; "1e3", "+2", ".5" are fine, "1,5", "nan", "inf", "3x" are not.
std::optional<double> parse_number(std::string_view text);
/// A whole number up to 2^53, also in the form "1e6".
std::optional<std::int64_t> parse_integer(std::string_view text);
/// "true" or "false".
std::optional<bool> parse_boolean(std::string_view text);
/// Two numbers separated by blanks.
std::optional<geometry::Vec2> parse_pair(std::string_view text);

} // namespace trime::app
