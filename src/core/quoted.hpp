// SPDX-License-Identifier: BSD-3-Clause
// Texts for messages. User input is quoted and shortened, because a line may have a megabyte. For a misspelt name,
// finds the most similar known name ("did you mean ...?").
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trime {

/// Returns at most 60 bytes of the text, followed by "..." if it is longer. Bytes that could disturb a terminal become
/// '?'.
std::string shown(std::string_view text);

/// Returns the shortened text in single quotes.
std::string quoted(std::string_view text);

/// Returns the message, without its middle if it has more than `longest` bytes; the default is about five lines.
std::string without_middle(const std::string& message, std::size_t longest = 600);

/// @brief Returns the candidate that differs from `word` by the fewest insertions, deletions, replacements and swaps of
/// neighbouring letters (Damerau-Levenshtein, optimal string alignment). Case is ignored; of equally similar candidates
/// the first is returned.
///
/// If more than a third of the letters differ in each candidate, returns the first candidate that begins with `word`,
/// or an empty text if no candidate does. Cost: O(letters^2) per candidate.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// Returns `; did you mean 'x'?` with the most similar candidate x, or an empty text.
std::string suggestion(std::string_view word, std::span<const std::string> candidates);

} // namespace trime
