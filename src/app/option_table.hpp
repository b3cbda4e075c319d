// SPDX-License-Identifier: BSD-3-Clause
// The table of all keys of a config file. Reading, error messages, `--help-config`, `--print-config`, the copy of the
// config in the mesh file and the table in configs/keys.md all use this table.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trime::app {

enum class OptionKind { number, integer, boolean, word, words, text, path, pair };

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
};

/// One key of a config. A list of words is separated by blanks or commas.
struct Option {
  const char* section; ///< section of the key; "shape.NAME", "region.NAME", "curve.NAME", "field.NAME" or "size.NAME"
                       ///< for keys of those
  const char* key;
  const char* part_type = ""; ///< for keys of parts: the type of part that has the key; empty: all types
  OptionKind kind = OptionKind::number;
  const char* fallback = ""; ///< default; empty: the key must be given, unless `meaning` says what happens without it
  const char* choices = "";  ///< allowed words; for keys with numbers, words that are allowed in place of a number
  Range range{};             ///< allowed range of numbers and integers
  const char* meaning;
};

/// Largest coordinate of the container. With larger ones, products of four differences could leave the range of a
/// double.
inline constexpr double largest_coordinate = 1e30;

inline constexpr std::string_view part_section = "shape.NAME";
inline constexpr std::string_view region_section = "region.NAME";
inline constexpr std::string_view curve_section = "curve.NAME";
inline constexpr std::string_view field_section = "field.NAME";
inline constexpr std::string_view size_section = "size.NAME";

std::span<const Option> option_table();

/// Returns the section in the table: "shape.NAME" for "shape.hole", "region.NAME" for "region.ore", "curve.NAME" for
/// "curve.fault", otherwise the section itself.
std::string_view table_section(std::string_view section);
/// Returns the option with this section and key; null if there is no such key.
const Option* find_option(std::string_view section, std::string_view key);
/// Returns the names of all sections ("shape.NAME", "region.NAME" and "curve.NAME" are among them), in the order of the
/// table.
std::vector<std::string> section_names();
/// Returns the keys of one section of the table.
std::vector<std::string> key_names(std::string_view section);

/// Splits a list into its words, which are separated by blanks.
std::vector<std::string> split_words(std::string_view text);
/// Splits a list into its words, which are separated by blanks or commas.
std::vector<std::string> split_list(std::string_view text);

/// Returns a description of the allowed values of a key, such as "a number > 0" or "auto or an integer from 1 to 10".
std::string expectation(const Option& option);

/// Returns why a value is wrong, without its line, such as `'radius = -1' in [shape.hole]: expected a number > 0`;
/// empty if the value is allowed.
std::string value_problem(const Option& option, std::string_view section, const std::string& value);

/// Returns the table in Markdown, as `--help-config` prints it.
std::string help_config();

} // namespace trime::app
