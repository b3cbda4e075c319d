// SPDX-License-Identifier: BSD-3-Clause
#include "contour_text.hpp"

#include "shape/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace trime::shape {

namespace {

using geometry::Vec2;

constexpr std::size_t most_shown = 60; // characters of a line in a message

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The next word, which blanks or the end follow; taken off `text`.
std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const auto end = std::find_if(text.begin(), text.end(), is_space);
  const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(word.size());
  return word;
}

/// What is beyond double precision: infinite, or 0 if it is tiny.
double out_of_range(std::string_view word) {
  long double wide = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), wide);
  return result.ec == std::errc{} && std::fabs(wide) < 1 ? static_cast<double>(wide) : HUGE_VAL;
}

/// @brief Is the word one number? Its value then. With d for e as Fortran writes.
bool is_number(std::string_view word, double& value) {
  if (!word.empty() && word.front() == '+')
    word.remove_prefix(1);
  if (word.empty() || word.front() == '+')
    return false;
  std::string with_e;
  if (const std::size_t d = word.find_first_of("dD"); d != std::string_view::npos && d > 0) {
    with_e = word;
    with_e[d] = 'e';
    word = with_e;
  }
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ptr != word.data() + word.size())
    return false;
  if (result.ec == std::errc::result_out_of_range)
    value = out_of_range(word);
  return result.ec != std::errc::invalid_argument;
}

/// The names of two columns; empty if the line is something else.
std::array<std::string, 2> column_names(std::string_view line) {
  std::string plain(line);
  for (char& c : plain)
    c = c == ',' || c == '"' || c == '\'' ? ' ' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  std::string_view rest = plain;
  std::array<std::string, 2> names;
  for (std::string& name : names)
    name = take_word(rest);
  return trimmed(rest).empty() ? names : std::array<std::string, 2>{};
}

constexpr std::array<std::array<std::string_view, 2>, 6> known_columns{
    {{"x", "y"}, {"lon", "lat"}, {"lng", "lat"}, {"long", "lat"}, {"longitude", "latitude"}, {"easting", "northing"}}};

/// Do the names stand for x and y, in this order or the other one?
bool are_columns(const std::array<std::string, 2>& names, bool swapped) {
  return std::any_of(known_columns.begin(), known_columns.end(), [&](const auto& known) {
    return names[0] == known[swapped ? 1 : 0] && names[1] == known[swapped ? 0 : 1];
  });
}

/// What people write instead of 'x y', for the message; empty if it is none of that.
std::string hint_for(std::string_view line, bool first) {
  if (first && are_columns(column_names(line), true))
    return "; the columns are in the other order: write x (longitude) before y (latitude), and take this line out";
  if (first && is_letter(line.front()) && !line.starts_with("nan") && !line.starts_with("inf"))
    return "; if this is a header, put '#' before it";
  if (line.front() == '{' || line.front() == '<')
    return "; this looks like GeoJSON or XML: convert it to lines 'x y' with a blank line between rings";
  if (line.find(',') != std::string_view::npos)
    return "; separate the numbers by blanks, not commas, and write decimals with a point";
  double number = 0;
  int numbers = 0;
  while (numbers < 4 && is_number(take_word(line), number))
    ++numbers;
  return numbers == 3 && trimmed(line).empty() ? "; found three numbers, but points of the plane have two" : "";
}

} // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_space(text.back()))
    text.remove_suffix(1);
  return text;
}

void check_encoding(std::string_view text, const std::string& source) {
  constexpr std::size_t looked_at = 1 << 12;
  const bool marked = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  if (!marked && text.substr(0, looked_at).find('\0') == std::string_view::npos)
    return;
  throw GeometryError(fmt::format("{}:1: expected plain text (ASCII or UTF-8), found {}", source,
                                  marked ? "UTF-16; save it as UTF-8, or run 'iconv -f UTF-16 -t UTF-8' on it"
                                         : "zero bytes: UTF-16 or no text at all; save it as UTF-8 text, lines 'x y'"));
}

std::string_view take_line(std::string_view& text) {
  std::size_t end = text.find_first_of("\r\n");
  std::size_t next = end == std::string_view::npos ? text.size() : end + 1;
  if (end != std::string_view::npos && text[end] == '\r') {
    const std::size_t after = text.find_first_not_of('\r', end);
    if (after != std::string_view::npos && text[after] == '\n')
      next = after + 1;
  }
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(next);
  return line;
}

std::optional<Vec2> VertexReader::read(std::string_view line, int number) {
  Vec2 p;
  std::string_view rest = line;
  if (is_number(take_word(rest), p.x) && is_number(take_word(rest), p.y) && trimmed(rest).empty()) {
    first_ = false;
    return p;
  }
  if (!first_ || !are_columns(column_names(line), false))
    refuse(line, number);
  first_ = false;
  warnings_.push_back(fmt::format("{}:{}: '{}' is taken as the names of the columns and left out", source_, number,
                                  line.substr(0, most_shown)));
  return std::nullopt;
}

void VertexReader::refuse(std::string_view line, int number) const {
  throw GeometryError(fmt::format("{}:{}: expected two numbers 'x y', found '{}'{}", source_, number,
                                  line.substr(0, most_shown), hint_for(line, first_)));
}

void check_coordinates(Vec2 p, const std::string& source, int line) {
  constexpr double most = ShapeRules::largest_coordinate;
  if (std::fabs(p.x) <= most && std::fabs(p.y) <= most)
    return;
  throw GeometryError(
      fmt::format("{}:{}: expected finite coordinates of at most {:g}, found ({}, {}){}", source, line, most, p.x, p.y,
                  std::isnan(p.x) && std::isnan(p.y) ? "; between rings write a blank line, or a line with '>'" : ""));
}

} // namespace trime::shape
