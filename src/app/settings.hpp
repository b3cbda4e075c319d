// SPDX-License-Identifier: BSD-3-Clause
// Checks an ini document against the option table: reports unknown sections, unknown keys and bad values. Gives all
// other values, with the defaults of the table.
#pragma once

#include "app/ini.hpp"
#include "app/option_table.hpp"
#include "trime/geometry/vec2.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace trime::app {

/// Look-ups are O(log(entries)), so that there may be very many parts.
class Settings {
public:
  /// Adds entries with problems to `problems`, and reads them as if they were absent. Copies what it needs.
  Settings(const IniDocument& document, Diagnostics& problems);

  /// Names of the sections [shape.NAME], in the order of the file.
  const std::vector<std::string>& parts() const { return parts_; }
  /// Line of the section in the file.
  int section_line(const std::string& section) const;

  /// Returns true if the user set the key, even to a bad value or with a misspelt name, so that no second error
  /// follows.
  bool is_set(const std::string& section, const std::string& key) const;
  /// Returns true if the key is set, but to a value that was refused, so that text() gives another value.
  bool was_refused(const std::string& section, const std::string& key) const;
  /// Line of the entry; io::whole_file if it is not set.
  int line(const std::string& section, const std::string& key) const;
  /// Place of the later of two entries: the command line comes after the file.
  int later_line(const std::string& section, const std::string& a, const std::string& b) const;
  /// The value in force as text: the user's if it is good, else the default of the table.
  std::string text(const std::string& section, const std::string& key) const;

  /// Returns the converted value; for keys with a value that is not one of the allowed words (auto, none).
  double number(const std::string& section, const std::string& key) const;
  bool boolean(const std::string& section, const std::string& key) const;
  geometry::Vec2 pair(const std::string& section, const std::string& key) const;
  /// Returns nothing if the value is missing or a word such as auto.
  std::optional<double> optional_number(const std::string& section, const std::string& key) const;
  std::optional<std::int64_t> optional_integer(const std::string& section, const std::string& key) const;
  std::int64_t integer(const std::string& section, const std::string& key) const;

  /// The whole config with all defaults as an ini text; reading it again, from anywhere, gives the same settings: paths
  /// of parts, relative to `directory`, become absolute.
  std::string resolved(const std::string& directory) const;

private:
  void check_sections(const IniDocument& document, Diagnostics& problems);
  void check_entry(const IniEntry& entry, Diagnostics& problems);
  void check_part(const std::string& section, Diagnostics& problems);
  bool is_known_section(const std::string& section) const;
  void keep(const IniEntry& entry);

  std::map<std::string, int> section_lines_; ///< where each section is opened first
  std::map<IniKey, int> lines_;              ///< line of each entry of the document
  std::vector<std::string> parts_;
  std::set<std::string> part_names_;                 ///< parts_, to find them
  std::map<IniKey, std::string> good_;               ///< values in force that the user has set
  std::map<std::string, std::vector<IniEntry>> own_; ///< values in force by section, in the order of the file
  std::set<IniKey> meant_;                           ///< what misspelt sections and keys were probably meant to set
  int misspelt_ = 0;                                 ///< names that are not known
};

} // namespace trime::app
