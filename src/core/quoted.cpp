// SPDX-License-Identifier: BSD-3-Clause
#include "core/quoted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace trime {
namespace {

/// Is it a byte that continues a character of UTF-8?
bool is_inside_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

} // namespace

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60; // of a line of 120 that has more to say
  std::size_t kept = text.size() <= longest ? text.size() : longest;
  while (kept < text.size() && kept > 0 && is_inside_character(text[kept]))
    --kept; // no half of a character
  std::string told(text.substr(0, kept));
  for (char& c : told)
    if (static_cast<unsigned char>(c) < 32 || c == 127)
      c = '?';
  if (kept < text.size())
    told += "...";
  return told;
}

std::string quoted(std::string_view text) {
  return fmt::format("'{}'", shown(text));
}

std::string without_middle(const std::string& message, std::size_t longest) {
  if (message.size() <= longest)
    return message;
  std::size_t end = longest / 2, begin = message.size() - longest / 4; // what is wrong comes first, the advice last
  while (end > 0 && is_inside_character(message[end]))
    --end;
  while (begin < message.size() && is_inside_character(message[begin]))
    ++begin;
  return fmt::format("{} ... {}", message.substr(0, end), message.substr(begin));
}

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j)
    d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

} // namespace

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t longest = 64; // longer words are not misspelt names
  if (word.size() > longest)
    return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() >= word.size() + best_distance)
      continue; // so much longer that it cannot be nearer
    const std::size_t distance = edit_distance(lower(word), lower(candidate));
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  constexpr std::size_t shortest_beginning = 3; // letters
  for (const std::string& candidate : candidates)
    if (best.empty() && word.size() >= shortest_beginning && lower(candidate).starts_with(lower(word)))
      best = candidate;
  return best;
}

std::string suggestion(std::string_view word, std::span<const std::string> candidates) {
  const std::string near = nearest_name(word, candidates);
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

} // namespace trime
