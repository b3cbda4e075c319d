// SPDX-License-Identifier: BSD-3-Clause
// Checks an ini document against the table of options. Reports unknown sections, unknown keys and wrong values;
// provides all other values, and the defaults of the table for missing ones.
#pragma once

#include "app/ini.hpp"
#include "app/option_table.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace trime::app {

/// Provides the checked values of a config. A look-up takes O(log(entries)) time, so that a shape may have very many
/// parts.
class Settings {
public:
  /// Adds a message to `problems` for each wrong entry, which then counts as missing. Copies all data that it needs.
  Settings(const IniDocument& document, Diagnostics& problems);

  /// Returns the names of the sections [shape.NAME] in the order of the file.
  const std::vector<std::string>& parts() const { return named_[parts_at].names; }
  /// Returns the names of the sections [region.NAME] in the order of the file.
  const std::vector<std::string>& regions() const { return named_[regions_at].names; }
  /// Returns the names of the sections [curve.NAME] in the order of the file.
  const std::vector<std::string>& curves() const { return named_[curves_at].names; }
  /// Returns the names of the sections [field.NAME] in the order of the file.
  const std::vector<std::string>& fields() const { return named_[fields_at].names; }
  /// Returns the names of the sections [size.NAME] in the order of the file.
  const std::vector<std::string>& sizes() const { return named_[sizes_at].names; }
  /// Returns the names of sections such as [fields.NAME], which are unknown, but were probably meant to be fields.
  const std::vector<std::string>& meant_fields() const { return meant_fields_; }
  /// Returns true if a section is unknown. Then a key that seems to be missing may be in it, so callers do not report
  /// that it is missing.
  bool has_unknown_section() const { return has_unknown_section_; }
  /// Returns the line of the section in the file.
  int section_line(const std::string& section) const;

  /// Returns true if the user set the key, even to a wrong value or under a misspelt name. Callers use this to avoid a
  /// second error about the same mistake.
  bool is_set(const std::string& section, const std::string& key) const;
  /// Returns true if the key is set to a wrong value, so that text() returns the default instead.
  bool was_refused(const std::string& section, const std::string& key) const;
  /// Returns the line of the entry; whole_file if the key is not set.
  int line(const std::string& section, const std::string& key) const;
  /// Returns the later of the lines of two entries. The command line counts as later than the file.
  int later_line(const std::string& section, const std::string& a, const std::string& b) const;
  /// Returns the value of a key as text: the user's value if it is allowed, otherwise the default of the table.
  std::string text(const std::string& section, const std::string& key) const;

  /// Returns the converted value. For keys whose value is not one of the allowed words (auto, none).
  double number(const std::string& section, const std::string& key) const;
  bool boolean(const std::string& section, const std::string& key) const;
  geometry::Vec2 pair(const std::string& section, const std::string& key) const;
  /// Returns the converted value; nothing if the value is missing or is a word such as auto.
  std::optional<double> optional_number(const std::string& section, const std::string& key) const;
  std::optional<std::int64_t> optional_integer(const std::string& section, const std::string& key) const;
  std::int64_t integer(const std::string& section, const std::string& key) const;

  /// Returns the whole config with all defaults as an ini text. Reading this text again, from any directory, gives the
  /// same settings: paths of parts relative to `directory` become absolute.
  std::string resolved(const std::string& directory) const;

private:
  /// The sections PREFIX.NAME.
  struct NamedSections {
    std::string_view prefix, section; ///< "shape." and its section in the table
    const char* what;                 ///< what such a name belongs to, for messages
    std::vector<std::string> names{};
    std::set<std::string> known{}; ///< the names, for searching
  };
  static constexpr std::size_t parts_at = 0, regions_at = 1, curves_at = 2, fields_at = 3, sizes_at = 4;

  const NamedSections* named(std::string_view section) const;
  void check_sections(const IniDocument& document, Diagnostics& problems);
  void check_entry(const IniEntry& entry, Diagnostics& problems);
  void check_part(const std::string& section, Diagnostics& problems);
  void check_given(const std::string& section, const std::string& key, Diagnostics& problems);
  void check_name(const IniSection& section, Diagnostics& problems);
  bool is_known_section(const std::string& section) const;
  std::string nearest_section(const std::string& section) const;
  std::string nearest_key(const IniEntry& entry) const;
  void add_unknown_section(const IniSection& section, Diagnostics& problems);
  void keep(const IniEntry& entry);

  std::map<std::string, int> section_lines_; ///< line in which each section begins first
  std::map<IniKey, int> lines_;              ///< line of each entry of the document
  std::array<NamedSections, 5> named_{{{"shape.", part_section, "part"},
                                       {"region.", region_section, "region"},
                                       {"curve.", curve_section, "curve"},
                                       {"field.", field_section, "field"},
                                       {"size.", size_section, "size"}}};
  std::map<IniKey, std::string> good_;               ///< all allowed values that the user has set
  std::map<std::string, std::vector<IniEntry>> own_; ///< all allowed values by section, in the order of the file
  std::set<IniKey> meant_;                           ///< known keys that are most similar to misspelt sections and keys
  std::vector<std::string> meant_fields_;            ///< see meant_fields()
  bool has_unknown_section_ = false;
  int misspelt_ = 0; ///< number of unknown names
};

} // namespace trime::app
