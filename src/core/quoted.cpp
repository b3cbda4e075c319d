// SPDX-License-Identifier: BSD-3-Clause
#include "core/quoted.hpp"

#include <fmt/format.h>

namespace trime {

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60; // of a line of 120 that has more to say
  std::size_t kept = text.size() <= longest ? text.size() : longest;
  while (kept < text.size() && kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xc0) == 0x80)
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

} // namespace trime
