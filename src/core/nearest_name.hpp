// SPDX-License-Identifier: BSD-3-Clause
// Finds the known name that is nearest to a misspelt one, for "Did you mean ...?".
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trime {

/// @brief Returns the candidate that differs from `word` by the fewest insertions, deletions, replacements and swaps of
/// neighbours (Damerau-Levenshtein, optimal string alignment). Upper and lower case are equal, and the first wins a
/// tie.
///
/// If more than a third of the letters differ in each candidate, returns the first one that begins with `word`, or an
/// empty text. Cost: O(letters^2) per candidate.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// Returns `; did you mean 'x'?` for the nearest candidate, or an empty text.
std::string suggestion(std::string_view word, std::span<const std::string> candidates);

} // namespace trime
