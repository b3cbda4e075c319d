// SPDX-License-Identifier: BSD-3-Clause
// Decides which parts of the boundary are open, that is, where water flows in and out of a coastal model (fort14).
#pragma once

#include "trime/formats/exchange.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::formats {

/// @brief Returns for each part of the boundary whether it is open. With Names::open_boundary, a part is open if the
/// list has its full name, the text before its first dot, or the text behind it. Without the list, a part is open if
/// "open", "ocean" or "sea" is a word of its name. Only the text behind the dot counts if there is a dot.
/// @throws ConfigError if no part has a name of the list
std::vector<bool> open_parts(const Names& names);

/// Returns "open boundary: NAMES; land boundary: NAMES" for the parts that have edges, with at most ten names each.
/// Split curves are land, or follow as weirs.
/// @param edges number of edges of each part, and of each curve @throws ConfigError as open_parts()
std::string open_boundary_text(const Names& names, const std::vector<std::int64_t>& edges);

} // namespace trime::formats
