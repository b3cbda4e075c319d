// SPDX-License-Identifier: BSD-3-Clause
#include "formats/solver_names.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <set>

namespace trime::formats {
namespace {

constexpr std::size_t longest_comment = 100;

// Not those of <cctype>, which depend on the locale.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
/// Returns whether a byte continues a character of UTF-8.
bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

std::string upper(std::string name) {
  for (char& c : name)
    if (c >= 'a' && c <= 'z')
      c = static_cast<char>(c - 'a' + 'A');
  return name;
}

std::string simplified(const std::string& name, std::size_t longest) {
  std::string made(!name.empty() && is_letter(name[0]) ? "" : "SET_");
  for (const char c : name)
    if (is_letter(c) || is_digit(c))
      made += c;
    else if (!continues_character(c))
      made += '_';
  return made.substr(0, longest);
}

} // namespace

std::vector<std::string> solver_names(const std::vector<std::string>& names, std::size_t longest) {
  std::vector<std::string> made;
  std::set<std::string> taken;               // in upper case
  std::map<std::string, std::int64_t> equal; // how many names were simplified to this one
  for (const std::string& name : names) {
    const std::string base = simplified(name, longest);
    std::string unique = base;
    for (std::int64_t& count = equal[upper(base)]; !taken.insert(upper(unique)).second;) {
      const std::string ending = fmt::format("_{}", count < 2 ? count = 2 : ++count);
      unique = base.substr(0, longest - ending.size()) + ending;
    }
    made.push_back(unique);
  }
  return made;
}

std::string in_comment(const std::string& name) {
  std::string made = name.substr(0, longest_comment);
  for (char& c : made)
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f)
      c = ' ';
  return made;
}

} // namespace trime::formats
