// SPDX-License-Identifier: BSD-3-Clause
#include "contours/map_features.hpp"

#include "core/quoted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace trime::contours {
namespace {

constexpr int first_line = 1; // says nothing, since most programs write a map in one line

/// The feature that has the number `line`, or null.
const MapFeature* feature_of(const Contour& contour, int line) {
  const auto k = static_cast<std::size_t>(line - 1);
  return line > 0 && k < contour.features.size() ? &contour.features[k] : nullptr;
}

std::string named(int number, const std::string& name) {
  return name.empty() ? fmt::format("feature {}", number) : fmt::format("feature {}, {}", number, trime::quoted(name));
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

} // namespace

std::string place_in_file(const std::string& source, int line, const std::string& feature) {
  return line > 0 ? fmt::format("{}:{}{}", source, line, feature) : source + feature;
}

std::string place_of_line(const Contour& contour, int line, const std::string& feature) {
  return place_in_file(contour.source, contour.is_map && line <= first_line ? 0 : line, feature);
}

std::string in_brackets(int number, const std::string& name) {
  return number == 0 ? std::string() : fmt::format(" ({})", named(number, name));
}

std::string where(const Contour& contour, int line) {
  const MapFeature* feature = feature_of(contour, line);
  if (feature == nullptr)
    return place_of_line(contour, line);
  return place_of_line(contour, feature->line, in_brackets(line, feature->name));
}

std::string line_or_feature(const Contour& contour, int line) {
  const MapFeature* feature = feature_of(contour, line);
  return feature == nullptr ? fmt::format("line {}", line) : named(line, feature->name);
}

int telling_rank(std::string_view attribute) {
  constexpr std::array<std::string_view, 4> numbers = {"osm_id", "fid", "gid", "id"},
                                            names = {"label", "title", "admin", "name"};
  const std::string word = lower(attribute);
  const auto rank_in = [&](const auto& words) {
    const auto found = std::find(words.begin(), words.end(), word);
    return found == words.end() ? 0 : 1 + static_cast<int>(found - words.begin());
  };
  if (const int rank = rank_in(names); rank > 0)
    return 2 * static_cast<int>(numbers.size()) + rank;
  if (word.find("name") != std::string::npos) // name_en, NAME_1, GEONAME
    return 2 * static_cast<int>(numbers.size());
  if (const int rank = rank_in(numbers); rank > 0)
    return static_cast<int>(numbers.size()) + rank - 1;
  return word.ends_with("id") || word.ends_with("code") ? 1 : 0;
}

} // namespace trime::contours
