// SPDX-License-Identifier: BSD-3-Clause
#include "formats/open_boundary.hpp"

#include "core/quoted.hpp"
#include "trime/core/error.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace trime::formats {
namespace {

constexpr std::size_t most_names = 10; // of a message

std::string before_dot(const std::string& name) {
  return name.substr(0, name.find('.'));
}
/// The whole name if it has no dot.
std::string behind_dot(const std::string& name) {
  return name.substr(name.find('.') + 1);
}

bool has_open_word(const std::string& text) {
  constexpr std::array<const char*, 3> words{"open", "ocean", "sea"};
  std::string word;
  for (std::size_t k = 0; k <= text.size(); ++k) {
    const auto c = static_cast<unsigned char>(k < text.size() ? text[k] : ' ');
    if (c < 128 && !std::isalpha(c)) { // bytes from 128 are parts of letters
      if (std::find(words.begin(), words.end(), word) != words.end())
        return true;
      word.clear();
    } else {
      word += static_cast<char>(std::tolower(c));
    }
  }
  return false;
}

/// At most ten names, and how many more there are.
std::string listed(const std::vector<std::string>& names) {
  if (names.empty())
    return "none";
  const std::size_t count = std::min(names.size(), most_names);
  const std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count), ", "));
  return count == names.size() ? text : fmt::format("{} and {} more", text, names.size() - count);
}

[[noreturn]] void refuse(const std::string& wanted, const std::vector<std::string>& parts) {
  std::vector<std::string> known = parts;
  for (const std::string& part : parts)
    known.push_back(behind_dot(part));
  throw ConfigError(fmt::format("open_boundary: no part of the boundary has the name '{}'{}; the names are {}; a "
                                "config separates several names by commas, a program gives a list",
                                shown(wanted), suggestion(wanted, known), listed(parts)));
}

} // namespace

std::vector<bool> open_parts(const Names& names) {
  std::vector<bool> open(names.parts.size());
  if (!names.open_boundary) {
    std::transform(names.parts.begin(), names.parts.end(), open.begin(),
                   [](const std::string& part) { return has_open_word(behind_dot(part)); });
    return open;
  }
  for (const std::string& wanted : *names.open_boundary) {
    bool is_known = false;
    for (std::size_t part = 0; part < open.size(); ++part)
      if (const std::string& name = names.parts[part];
          wanted == name || wanted == before_dot(name) || wanted == behind_dot(name))
        open[part] = is_known = true;
    if (!is_known)
      refuse(wanted, names.parts);
  }
  return open;
}

std::string open_boundary_text(const Names& names, const std::vector<std::int64_t>& edges) {
  const std::vector<bool> open = open_parts(names);
  std::array<std::vector<std::string>, 2> parts;
  for (std::size_t part = 0; part < open.size(); ++part)
    if (edges.at(part) > 0)
      parts[open[part] ? 0 : 1].push_back(names.parts[part]);
  std::vector<std::string> weirs;
  for (std::size_t k = 0; k < std::min(names.curves.size(), names.curve_kinds.size()); ++k)
    if (const std::size_t name = names.parts.size() + k; name < edges.size() && edges[name] > 0)
      (names.curve_kinds[k].weir_height ? weirs : parts[1]).push_back(names.curves[k]);
  return fmt::format("open boundary: {}; land boundary: {}{}", listed(parts[0]), listed(parts[1]),
                     weirs.empty() ? "" : "; weirs: " + listed(weirs));
}

} // namespace trime::formats
