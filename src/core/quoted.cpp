// SPDX-License-Identifier: BSD-3-Clause
#include "core/quoted.hpp"

#include <fmt/format.h>

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

} // namespace trime
