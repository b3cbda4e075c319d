// SPDX-License-Identifier: BSD-3-Clause
// Makes names that a solver with narrow rules accepts from the names of regions and boundaries.
#pragma once

#include <string>
#include <vector>

namespace trime::formats {

/// @brief Returns names for Abaqus, CalculiX and others in the order of the given names. A name begins with a letter,
/// consists of at most `longest` letters, digits and underscores of ASCII, and differs from all others even if upper
/// and lower case count as equal. Other characters become underscores. Where two names would be equal, the later one
/// ends with _2, _3 and so on. Cost: O(n log n), however many names are equal.
/// @pre longest is larger than the number of digits of the number of names
std::vector<std::string> solver_names(const std::vector<std::string>& names, std::size_t longest = 80);

/// Returns a name for a comment in one line: control characters become blanks, and at most 100 bytes remain.
std::string in_comment(const std::string& name);

} // namespace trime::formats
