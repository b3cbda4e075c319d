// SPDX-License-Identifier: BSD-3-Clause
// Reader of ini texts that knows where every value came from: sections, `key = value`, comments. A comment goes from
// `;` or `#`, at the start of a line or after a blank, to its end. It knows no keys: what they mean is the business of
// the caller. All
// problems are collected, so that a user sees every mistake of a file at once.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trime::app {

/// Line number of values given on the command line.
inline constexpr int command_line_origin = 0;
/// Line number of problems that belong to the whole file (something is missing).
inline constexpr int whole_file = -1;

/// One `key = value`, blanks at both ends removed.
struct IniEntry {
  std::string section, key, value;
  int line = whole_file; ///< from 1; command_line_origin for overrides
};

/// Section and key.
using IniKey = std::pair<std::string, std::string>;

struct IniSection {
  std::string name;
  int line = whole_file;
};

/// @brief Mistakes with their places.
class Diagnostics {
public:
  /// @param file name of the file for messages
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}
  void add(int line, std::string message) { problems_.push_back({line, std::move(message)}); }
  /// Place of a line as it stands before messages: "file:17", "command line", or "file" for the whole of it.
  std::string place(int line) const;
  bool empty() const { return problems_.empty(); }
  std::size_t size() const { return problems_.size(); }
  /// @brief One line per problem: `file:17: ...` in the order of the file, then those of the whole file (`file: ...`),
  /// then `command line: ...`. After `limit` lines it gives only the number of the others.
  std::string text(std::size_t limit = 30) const;
  /// @throws ConfigError with text() if there is any problem
  void throw_if_any() const;

private:
  struct Problem {
    int line;
    std::string message;
  };
  std::string file_;
  std::vector<Problem> problems_;
};

/// Sections and entries in the order of the text. Invariant: no two entries have the same section and key.
struct IniDocument {
  std::vector<IniSection> sections;
  std::vector<IniEntry> entries;

  /// Returns null if the entry is missing. O(entries).
  const IniEntry* find(std::string_view section, std::string_view key) const;
};

/// @brief Reads a text. Duplicates, repeated sections, keys before the first section, empty values and unreadable lines
/// go to `problems`; reading continues after them. O(characters + entries log(entries)).
IniDocument parse_ini(std::string_view text, Diagnostics& problems);

/// @brief Sets one value as given on the command line: `section.key=value`, the section being all before the last dot
/// of the left side. An empty value takes the entry away, so that the default holds. Replaces what the file or an
/// earlier override says: scripts append the wishes of their users to their own.
void apply_override(IniDocument& document, std::string_view text, Diagnostics& problems);

} // namespace trime::app
