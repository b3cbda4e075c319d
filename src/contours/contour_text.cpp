// SPDX-License-Identifier: BSD-3-Clause
#include "contours/contour_text.hpp"

#include "contours/faults.hpp"
#include "contours/map_features.hpp"
#include "contours/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/ranges.h>

namespace trime::contours {

namespace {

using geometry::Vec2;

constexpr std::size_t most_shown = 60; // characters of a line in a message

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Blanks at both ends, and one comma behind a number: `1, 2` and `1,2` are two numbers.
std::string_view without_comma(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with(','))
    text.remove_prefix(1);
  return text;
}

/// The next word, which blanks or the end follow; taken off `text`.
std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const auto end = std::find_if(text.begin(), text.end(), is_space);
  const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(word.size());
  return word;
}

/// Returns the value of a number beyond double precision: infinite, or 0 if it is tiny.
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
  if (const auto plain = std::from_chars(word.data(), word.data() + word.size(), value);
      plain.ec == std::errc{} && plain.ptr == word.data() + word.size())
    return true;
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

/// The names of two columns, which a third one may follow; empty if the line is something else.
std::array<std::string, 2> column_names(std::string_view line) {
  std::string plain(line);
  for (char& c : plain)
    c = c == ',' || c == '"' || c == '\'' ? ' ' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  std::string_view rest = plain;
  std::array<std::string, 2> names;
  for (std::string& name : names)
    name = take_word(rest);
  const std::string_view third = take_word(rest);
  return trimmed(rest).empty() && (third.empty() || is_letter(third.front())) ? names : std::array<std::string, 2>{};
}

constexpr std::array<std::array<std::string_view, 2>, 6> known_columns{
    {{"x", "y"}, {"lon", "lat"}, {"lng", "lat"}, {"long", "lat"}, {"longitude", "latitude"}, {"easting", "northing"}}};

/// Do the names stand for x and y, in this order or the other one?
bool are_columns(const std::array<std::string, 2>& names, bool swapped) {
  return std::any_of(known_columns.begin(), known_columns.end(), [&](const auto& known) {
    return names[0] == known[swapped ? 1 : 0] && names[1] == known[swapped ? 0 : 1];
  });
}

/// The first number of a line, taken off it: a comma, a blank or both follow.
bool take_first(std::string_view& line, double& value) {
  const auto after = std::find_if(line.begin(), line.end(), [](char c) { return c == ',' || c == ' ' || c == '\t'; });
  const auto end = static_cast<std::size_t>(after - line.begin());
  if (!is_number(line.substr(0, end), value))
    return false;
  line = without_comma(line.substr(end));
  return true;
}

/// Recognises what people write instead of 'x y', for the message; empty if it is something else.
std::string hint_for(std::string_view line, bool first) {
  if (first && are_columns(column_names(line), true))
    return "the columns are in the other order: write x (longitude) before y (latitude), and take this line out";
  if (first && is_letter(line.front()) && !line.starts_with("nan") && !line.starts_with("inf"))
    return "if this is a header, put '#' before it";
  if (line.front() == '{' || line.front() == '<')
    return "this looks like GeoJSON or XML: rename GeoJSON to NAME.geojson; convert other formats to lines 'x y' "
           "with a blank line between rings";
  if (line.find(',') != std::string_view::npos)
    return "write decimals with a point, and blanks or one comma between the two numbers";
  double number = 0;
  int numbers = 0;
  while (numbers < 4 && is_number(take_word(line), number))
    ++numbers;
  return numbers == 3 && trimmed(line).empty() ? "; points in the plane have two numbers: remove the third column" : "";
}

/// A line between whose numbers semicolons stand.
struct SemicolonRow {
  std::vector<std::string> numbers; // with decimal points; empty if the line is something else
  bool comma_first = false, comma_second = false;
};

SemicolonRow semicolon_row(std::string_view line) {
  SemicolonRow row;
  if (line.find(';') == std::string_view::npos)
    return row;
  if (line.ends_with(';'))
    line.remove_suffix(1);
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(';', at), line.size());
    std::string field(trimmed(line.substr(at, end - at)));
    if (const std::size_t comma = field.find(','); comma != std::string::npos) {
      (row.numbers.empty() ? row.comma_first : row.comma_second) = true;
      field[comma] = '.';
    }
    double value = 0;
    if (!is_number(field, value))
      return {};
    row.numbers.push_back(std::move(field));
    at = end + 1;
  }
  return row;
}

/// Writes the lines of a text without semicolons, and finds which forms they have.
class SemicolonText {
public:
  void add(std::string_view line, int number) {
    line = trimmed(line.substr(0, line.find('#')));
    const SemicolonRow row = semicolon_row(line);
    if (row.numbers.size() > 1) {
      plain_ += fmt::format("{}", fmt::join(row.numbers, " "));
      comma_ = comma_ == 0 && row.comma_first ? number : comma_;
      comma_second_ = comma_second_ || row.comma_second;
      rows_ = true;
    } else if (line.empty() || line.front() == '>' || line.front() == ';') {
      plain_ += line.substr(0, line.find(';'));
    } else if (const std::string names = columns_of(line); !rows_ && !names.empty()) {
      plain_ += names;
    } else {
      other_ = other_ == 0 ? number : other_;
    }
    plain_ += '\n';
  }

  std::optional<std::string> take(const std::string& source) {
    constexpr const char* remedy = "write decimals with a point, a blank between numbers, and '#' before comments";
    if (comma_ > 0 && other_ > 0)
      throw GeometryError(fmt::format("{}:{}: expected lines of one form, found decimal commas and a semicolon in this "
                                      "line, as in '10,15;20,55', and another form in line {}; {}",
                                      source, comma_, other_, remedy));
    if (comma_ > 0 && !comma_second_)
      throw GeometryError(fmt::format("{}:{}: expected two numbers 'x y', found numbers with ',' and ';' that can be "
                                      "read in two ways: '10,15;20' is (10.15, 20), or (10, 15) with a comment; {}",
                                      source, comma_, remedy));
    return rows_ && other_ == 0 ? std::optional(std::move(plain_)) : std::nullopt;
  }

private:
  /// The names of two columns with a blank between them, or nothing.
  static std::string columns_of(std::string_view line) {
    std::string names(line);
    std::replace(names.begin(), names.end(), ';', ' ');
    const auto words = column_names(names);
    return are_columns(words, false) || are_columns(words, true) ? names : std::string();
  }

  std::string plain_;
  bool rows_ = false;         // some line has numbers with semicolons between them
  int other_ = 0, comma_ = 0; // the first line of another form, and the first one like '10,15;20'
  bool comma_second_ = false;
};

} // namespace

std::optional<std::string> without_semicolons(std::string_view text, const std::string& source) {
  if (text.find(';') == std::string_view::npos)
    return std::nullopt;
  if (text.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
    text.remove_prefix(3);
  SemicolonText lines;
  for (int number = 1; !text.empty(); ++number)
    lines.add(take_line(text), number);
  return lines.take(source);
}

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
  const auto at = std::find_if(text.begin(), text.end(), [](char c) { return c == '\r' || c == '\n'; });
  const auto end = static_cast<std::size_t>(at - text.begin());
  std::size_t next = std::min(end + 1, text.size());
  if (end < text.size() && text[end] == '\r') {
    const std::size_t after = text.find_first_not_of('\r', end);
    if (after != std::string_view::npos && text[after] == '\n')
      next = after + 1;
  }
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(next);
  return line;
}

std::optional<Vec2> pair_of_numbers(std::string_view line) {
  Vec2 p;
  if (take_first(line, p.x) && is_number(take_word(line), p.y) && trimmed(line).empty())
    return p;
  return std::nullopt;
}

std::optional<Vec2> first_two_of_three(std::string_view line) {
  const auto commas = std::count(line.begin(), line.end(), ',');
  Vec2 p;
  double third = 0;
  if ((commas != 0 && commas != 2) || !take_first(line, p.x))
    return std::nullopt;
  const auto commas_left = std::count(line.begin(), line.end(), ',');
  if (commas_left != commas / 2 || !take_first(line, p.y) || line.find(',') != std::string_view::npos)
    return std::nullopt;
  return is_number(take_word(line), third) && trimmed(line).empty() ? std::optional(p) : std::nullopt;
}

/// Does the line hold names of columns before all vertices? Adds the warning then.
bool VertexReader::skips_columns(std::string_view line, int number) {
  if (!first_ || !are_columns(column_names(line), false))
    return false;
  first_ = false;
  warnings_.push_back(fmt::format("{}:{}: '{}' seems to hold the names of the columns and is ignored", source_, number,
                                  line.substr(0, most_shown)));
  return true;
}

std::optional<Vec2> VertexReader::read(std::string_view line, int number) {
  FaultList faults;
  const std::optional<Vec2> p = read(line, number, faults);
  check_faults(faults, source_, Faults::refuse);
  return p;
}

std::optional<Vec2> VertexReader::read(std::string_view line, int number, FaultList& faults) {
  const std::optional<Vec2> p = pair_of_numbers(line);
  if (!p && !skips_columns(line, number))
    add_fault(faults, HasArea::yes, [&]() -> Fault {
      return {fmt::format("{}:{}", source_, number),
              fmt::format("expected two numbers 'x y', found '{}'", line.substr(0, most_shown)), hint_for(line, first_),
              ""};
    });
  first_ = false;
  return p;
}

WordLines::WordLines(std::string_view text, const std::string& source, std::string_view separators)
    : rest_(text), source_(source), separators_(separators) {
  if (rest_.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
    rest_.remove_prefix(3);
}

bool WordLines::next() {
  words_.clear();
  while (words_.empty() && !rest_.empty()) {
    line_ = take_line(rest_);
    ++number_;
    line_ = trimmed(line_.substr(0, line_.find('#')));
    const auto parts = [this](char c) { return is_space(c) || separators_.find(c) != std::string_view::npos; };
    for (std::size_t at = 0; at < line_.size();) {
      while (at < line_.size() && parts(line_[at]))
        ++at;
      const std::size_t first = at;
      while (at < line_.size() && !parts(line_[at]))
        ++at;
      if (at > first)
        words_.push_back(line_.substr(first, at - first));
    }
  }
  return !words_.empty();
}

double WordLines::number_at(std::size_t k, const char* what) const {
  double value = 0;
  if (k >= words_.size() || !is_number(words_[k], value))
    refuse(what);
  return value;
}

int WordLines::integer_at(std::size_t k, const char* what) const {
  constexpr double most = 2147483647;
  const double value = number_at(k, what);
  if (!(std::fabs(value) <= most) || value != std::trunc(value))
    refuse(what);
  return static_cast<int>(value);
}

void WordLines::refuse(const std::string& what, const std::string& hint) const {
  const std::string found =
      words_.empty() ? std::string("the end of the file") : fmt::format("'{}'", line_.substr(0, most_shown));
  throw GeometryError(
      fmt::format("{}:{}: expected {}, found {}{}{}", source_, number_, what, found, hint.empty() ? "" : "; ", hint));
}

void check_coordinates(Vec2 p, const std::string& source, int line, const std::string& feature) {
  constexpr double most = ContourRules::largest_coordinate;
  if (std::fabs(p.x) <= most && std::fabs(p.y) <= most)
    return;
  throw GeometryError(fmt::format(
      "{}: expected finite coordinates of at most {:g}, found ({}, {}){}", place_in_file(source, line, feature), most,
      p.x, p.y, std::isnan(p.x) && std::isnan(p.y) ? "; between rings write a blank line, or a line with '>'" : ""));
}

} // namespace trime::contours
