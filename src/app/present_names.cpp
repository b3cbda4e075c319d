// SPDX-License-Identifier: BSD-3-Clause
#include "app/present_names.hpp"

#include "core/quoted.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trime::app {
namespace {

struct OldKey {
  std::string_view section, key, present;
};
constexpr OldKey old_keys[] = {{"shape", "region", "geometry"}};

/// The program takes an old value without a warning: it is a matter of taste.
struct OldValue {
  std::string_view section, key, value, present;
};
constexpr OldValue old_values[] = {{"meshing", "method", "cvd", "cvt"}};

/// Renames a key of the file, unless the present key is set, too.
void rename(const OldKey& old, IniDocument& document, Diagnostics& problems, std::vector<std::string>& warnings) {
  const bool has_both = document.find(old.section, old.present) != nullptr;
  const auto is_old = [&](const IniEntry& entry) { return entry.section == old.section && entry.key == old.key; };
  for (IniEntry& entry : document.entries)
    if (is_old(entry) && has_both) {
      problems.add(entry.line, fmt::format("'{}' in [{}] is the old name of '{}', which is set, too; keep only '{}'",
                                           old.key, old.section, old.present, old.present));
    } else if (is_old(entry)) {
      warnings.push_back(fmt::format("{}: '{}' in [{}] has a new name; write '{} = {}' instead",
                                     problems.place(entry.line), old.key, old.section, old.present,
                                     shown(entry.value)));
      entry.key = old.present;
    }
  std::erase_if(document.entries, is_old);
}

/// The override with the present name of its key.
std::string renamed(const std::string& override_text, std::vector<std::string>& warnings) {
  for (const OldKey& old : old_keys)
    if (const std::string name = fmt::format("{}.{}", old.section, old.key); override_text.starts_with(name + "=")) {
      const std::string present = fmt::format("{}.{}", old.section, old.present);
      warnings.push_back(fmt::format("command line: '{}' has a new name; write '{}=...' instead", name, present));
      return present + override_text.substr(name.size());
    }
  return override_text;
}

} // namespace

IniDocument read_document(std::string_view text, const std::vector<std::string>& overrides, Diagnostics& problems,
                          std::vector<std::string>& warnings) {
  IniDocument document = parse_ini(text, problems);
  for (const OldKey& old : old_keys)
    rename(old, document, problems, warnings);
  for (const std::string& override_text : overrides)
    apply_override(document, renamed(override_text, warnings), problems);
  for (IniEntry& entry : document.entries)
    for (const OldValue& old : old_values)
      if (entry.section == old.section && entry.key == old.key && entry.value == old.value)
        entry.value = old.present;
  return document;
}

} // namespace trime::app
