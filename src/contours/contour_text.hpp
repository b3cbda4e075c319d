// SPDX-License-Identifier: BSD-3-Clause
// Reads lines and numbers from the text of contours and point files, with messages for users whose text has another
// format. Each format has a reader in a separate source file; the reader of ESRI shapefiles uses libshp.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// Returns the text without blanks and carriage returns at both ends.
std::string_view trimmed(std::string_view text);

/// @brief Throws for text in UTF-16 and for binary data.
/// @throws GeometryError
void check_encoding(std::string_view text, const std::string& source);

/// @brief Removes the first line from `text` and returns it. A line ends with LF, CR LF or CR. Of several CR right
/// before a LF, all belong to the line end.
std::string_view take_line(std::string_view& text);

/// @brief Returns the text with each line `10,15;20,55` or `x;y` written as `10.15 20.55` or `x y`, if all lines have
/// this form: pairs of numbers with a semicolon between them, as spreadsheets write them in many countries. Returns
/// nothing for any other text, in which ';' starts a comment.
/// @throws GeometryError `source:line: ...` for a text that can be read in both ways, or where only some lines have
/// this form
std::optional<std::string> without_semicolons(std::string_view text, const std::string& source);

/// Calls visit(content, number, separates) for every line: its content without comment, its number from 1, and whether
/// the line separates rings. Blank lines and lines that start with '>' (GMT) separate rings, and have no content.
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

/// Returns the two numbers of a line, or nothing if the line holds anything else.
std::optional<geometry::Vec2> pair_of_numbers(std::string_view line);

/// Returns the first two numbers of a line with three numbers, between which there are only blanks or always one comma;
/// nothing for any other line.
std::optional<geometry::Vec2> first_two_of_three(std::string_view line);

/// Reads the vertices of one text, line by line.
class VertexReader {
public:
  explicit VertexReader(const std::string& source) : source_(source) {}

  /// @brief Returns the vertex on a line with content. Returns nothing if the line holds column names such as 'x y' and
  /// comes before all vertices.
  ///
  /// Exponents may be written with e or d (Fortran). A number that is too small for double precision counts as 0.
  /// @throws GeometryError `source:line: ...` that says how to correct the line
  std::optional<geometry::Vec2> read(std::string_view line, int number);
  /// Reads a line as the other function does, but a line that holds anything else becomes a fault, and the result is
  /// empty.
  std::optional<geometry::Vec2> read(std::string_view line, int number, FaultList& faults);
  /// Returns warnings for the user about a skipped line of column names.
  const std::vector<std::string>& warnings() const { return warnings_; }

private:
  bool skips_columns(std::string_view line, int number);

  const std::string& source_;
  std::vector<std::string> warnings_;
  bool first_ = true; // true until the first line with content
};

/// @brief Splits a text of numbers into lines and words. Comments begin with '#'; lines without words are skipped.
class WordLines {
public:
  /// @param separators characters that separate words, in addition to blanks and tabs
  WordLines(std::string_view text, const std::string& source, std::string_view separators);

  /// Moves on to the next line with words. Returns false if there is no such line.
  bool next();
  int number() const { return number_; } ///< number of the line, from 1
  const std::vector<std::string_view>& words() const { return words_; }
  /// @brief Returns word k as a number.
  /// @throws GeometryError that names `what` as the expected value
  double number_at(std::size_t k, const char* what) const;
  /// Returns word k as an integer that fits into an int.
  int integer_at(std::size_t k, const char* what) const;
  [[noreturn]] void refuse(const std::string& what, const std::string& hint = "") const;

private:
  std::string_view rest_;
  const std::string& source_;
  std::string_view separators_, line_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

/// @brief Throws for coordinates that are not finite or larger than ContourRules::largest_coordinate.
/// @throws GeometryError `source:line: ...`
void check_coordinates(geometry::Vec2 p, const std::string& source, int line, const std::string& feature = {});

/// @brief Returns the rings of the polygons of a shapefile, and of lines that form rings. In place of a line number,
/// each vertex gets the number of its record, from 1. NAME.shx must be in the same directory; NAME.prj names the
/// reference system.
/// @param hint text that ends the error message if the file cannot be opened
/// @param attribute the attribute in NAME.dbf that names the boundary, see parse_geojson; may be empty. Texts in the
/// .dbf file are UTF-8 or Latin-1
/// @throws FileError if a file is missing or damaged; ConfigError if there is no such attribute; GeometryError
/// `source:record: ...` for lines that are not closed
/// @note Serial.
Contour read_shapefile(const std::string& path, const std::string& hint, const std::string& attribute, Faults faults);

/// @brief Appends a line of a curve to the rings. A line of at least four vertices that ends where it starts is a ring.
/// @throws GeometryError `source:line: ...` if all vertices are equal
void add_line(Contour& contour, std::span<const FilePoint> vertices, int marker);

// Read the lines of curves, see read_curves.
Contour parse_geojson_lines(std::string_view text, const std::string& source, const std::string& attribute);
Contour read_shapefile_lines(const std::string& path, const std::string& hint, const std::string& attribute);

} // namespace trime::contours
