// SPDX-License-Identifier: BSD-3-Clause
// Texts for messages: what users wrote, quoted and shortened (a line of a megabyte helps nobody), and the known name
// that is nearest to a misspelt one, for "Did you mean ...?".
#pragma once

#include <span>
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
