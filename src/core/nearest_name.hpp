// SPDX-License-Identifier: BSD-3-Clause
// Finds the known name that is nearest to a misspelt one, for "Did you mean ...?".
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trime {

/// @brief The candidate that differs from `word` by the fewest insertions, deletions, replacements and swaps of
/// neighbours (Damerau-Levenshtein, optimal string alignment). Upper and lower case are equal, and the first wins a
/// tie.
///
/// If more than a third of the letters differ in all of them: the first that begins with `word`, else empty.
/// O(letters^2) per candidate.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// `; did you mean 'x'?` for the nearest candidate, or nothing.
std::string suggestion(std::string_view word, std::span<const std::string> candidates);

} // namespace trime
