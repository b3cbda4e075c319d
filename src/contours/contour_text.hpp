// SPDX-License-Identifier: BSD-3-Clause
// Reads the text of contours and point files: lines, numbers, and messages for users whose text is something else.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// Without blanks at both ends; a carriage return counts as a blank.
std::string_view trimmed(std::string_view text);

/// @brief Refuses text that is not made of bytes for characters (UTF-16, binary data). @throws GeometryError
void check_encoding(std::string_view text, const std::string& source);

/// @brief Takes the first line off `text`; it ends at a line feed, at a carriage return, or at both.
///
/// Carriage returns right before a line feed belong to it; any other one ends a line by itself.
std::string_view take_line(std::string_view& text);

/// Calls visit(content without comment, number from 1, does the line part rings?) for every line. Blank lines and
/// those that start with '>' (GMT) part rings; their content is empty.
template <class Visit>
void for_each_line(std::string_view text, const Visit& visit) {
  if (text.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
    text.remove_prefix(3);
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    const bool parts = line.empty() || line.front() == '>';
    const auto comment = std::find_if(line.begin(), line.end(), [](char c) { return c == '#' || c == ';'; });
    const auto length = static_cast<std::size_t>(comment - line.begin());
    visit(parts ? std::string_view{} : trimmed(line.substr(0, length)), number, parts);
  }
}

/// Reads the lines of one text, one after the other.
class VertexReader {
public:
  explicit VertexReader(const std::string& source) : source_(source) {}

  /// @brief The vertex of a line with content; nothing for a line of column names, 'x y' or the like, before all
  /// vertices.
  ///
  /// Exponents may be written with e or d (Fortran). A number too small for double precision is 0.
  /// @throws GeometryError `source:line: ...` with what to do about it
  std::optional<geometry::Vec2> read(std::string_view line, int number);
  /// For the user: of a line of column names.
  const std::vector<std::string>& warnings() const { return warnings_; }

private:
  [[noreturn]] void refuse(std::string_view line, int number) const;

  const std::string& source_;
  std::vector<std::string> warnings_;
  bool first_ = true; // no line with content so far
};

/// @brief The lines of a text of numbers, one after the other, as words. Comments begin with '#'; lines without words
/// are left out.
class WordLines {
public:
  /// @param separators separate words, in addition to blanks and tabs
  WordLines(std::string_view text, const std::string& source, std::string_view separators);

  /// Goes to the next line with words. @return is there one?
  bool next();
  int number() const { return number_; } ///< of the line, from 1
  const std::vector<std::string_view>& words() const { return words_; }
  /// @brief Word k as a number. @throws GeometryError naming `what` was expected
  double number_at(std::size_t k, const char* what) const;
  /// Reads an integer that fits into an int.
  int integer_at(std::size_t k, const char* what) const;
  [[noreturn]] void refuse(const std::string& what) const;

private:
  std::string_view rest_;
  const std::string& source_;
  std::string_view separators_, line_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

/// @brief Refuses coordinates that are not finite or larger than ContourRules::largest_coordinate.
/// @throws GeometryError `source:line: ...`
void check_coordinates(geometry::Vec2 p, const std::string& source, int line, const std::string& feature = {});

} // namespace trime::contours
