// SPDX-License-Identifier: BSD-3-Clause
// Reads ini texts: sections, `key = value`, comments. Each value keeps its line for messages. A comment begins with `;`
// or `#` at the start of a line or after a blank, and goes to the end of the line. The reader does not know which keys
// exist. All mistakes are collected, so that a user sees every mistake of a file at once.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trime::app {

/// Line number of values that were given on the command line.
inline constexpr int command_line_origin = 0;
/// Line number of mistakes that concern the whole file, such as a missing section.
inline constexpr int whole_file = -1;

/// One `key = value`, without blanks at both ends of key and value.
struct IniEntry {
  std::string section, key, value;
  int line = whole_file; ///< from 1; command_line_origin for overrides
};

/// The section and the key of a value.
using IniKey = std::pair<std::string, std::string>;

struct IniSection {
  std::string name;
  int line = whole_file;
};

/// @brief Collects mistakes in a config, with their lines.
class Diagnostics {
public:
  /// @param file name of the file, which messages begin with
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}
  void add(int line, std::string message) { problems_.push_back({line, std::move(message)}); }
  /// Returns the text that begins messages about a line: "file:17", "command line", or "file" for the whole file.
  std::string place(int line) const;
  bool empty() const { return problems_.empty(); }
  std::size_t size() const { return problems_.size(); }
  /// @brief Returns one line per mistake: first `file:17: ...` in the order of the file, then mistakes of the whole
  /// file (`file: ...`), then `command line: ...`. After `limit` lines it gives only the number of the remaining
  /// mistakes.
  std::string text(std::size_t limit = 30) const;
  /// Throws if there is any mistake.
  /// @throws ConfigError with text()
  void throw_if_any() const;

private:
  struct Problem {
    int line;
    std::string message;
  };
  std::string file_;
  std::vector<Problem> problems_;
};

/// The sections and entries of an ini text, in its order. Invariant: no two entries have the same section and key.
struct IniDocument {
  std::vector<IniSection> sections;
  std::vector<IniEntry> entries;

  /// Returns the entry, or null if it is missing. Cost: O(entries).
  const IniEntry* find(std::string_view section, std::string_view key) const;
};

/// @brief Reads a text. Duplicates, repeated sections, keys before the first section, empty values and unreadable lines
/// are added to `problems`; reading continues after them. Cost: O(characters + entries log(entries)).
IniDocument parse_ini(std::string_view text, Diagnostics& problems);

/// @brief Sets one value as given on the command line: `section.key=value`, where the section is everything before the
/// last dot on the left side. An empty value removes the entry, so that the default holds. The value replaces that of
/// the file or of an earlier override, so that a script can append the user's overrides to its own.
void apply_override(IniDocument& document, std::string_view text, Diagnostics& problems);

} // namespace trime::app
