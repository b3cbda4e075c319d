// SPDX-License-Identifier: BSD-3-Clause
// The one table of all keys of a config file. Reading, error messages, `--help-config`, `--print-config`, the copy in
// the mesh file and the table in configs/keys.md all come from it.
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

/// One key. Lists of words are separated by blanks.
struct Option {
  const char* section; ///< parts of the shape: "shape.NAME"
  const char* key;
  const char* part_type = ""; ///< parts only: the type that the key belongs to; empty: all
  OptionKind kind = OptionKind::number;
  const char* fallback = ""; ///< default; empty: the key must be given, or the meaning says what holds without it
  const char* choices = "";  ///< words that are allowed (for numbers: in addition to a number)
  Range range{};             ///< number, integer
  const char* meaning;
};

/// Coordinates of the container; beyond, products of four differences could leave the range of a double.
inline constexpr double largest_coordinate = 1e30;

inline constexpr std::string_view part_section = "shape.NAME";

std::span<const Option> option_table();

/// "shape.NAME" for "shape.hole", else the section itself.
std::string_view table_section(std::string_view section);
/// Returns null if there is no such key.
const Option* find_option(std::string_view section, std::string_view key);
/// Names of all sections ("shape.NAME" among them), in the order of the table.
std::vector<std::string> section_names();
/// Keys of one section of the table.
std::vector<std::string> key_names(std::string_view section);

/// Words of a list separated by blanks.
std::vector<std::string> split_words(std::string_view text);

/// "a number > 0", "auto or an integer from 1 to 10": what may stand behind the key.
std::string expectation(const Option& option);

/// Returns what is wrong with a value, without its place, such as `'radius = -1' in [shape.hole]: expected a number >
/// 0`; empty if the value is good.
std::string value_problem(const Option& option, std::string_view section, const std::string& value);

/// The table as Markdown, as `--help-config` prints it.
std::string help_config();

} // namespace trime::app
