// SPDX-License-Identifier: BSD-3-Clause
#include "app/settings.hpp"

#include "app/option_value.hpp"
#include "core/distance_formula.hpp"
#include "core/quoted.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace trime::app {
namespace {

constexpr int most_misspelt = 100; // names for which the nearest known one is sought: more than Diagnostics::text shows
const std::vector<std::string> reserved_names{"domain", "union", "intersection", "difference"};

bool is_part_name(std::string_view name) {
  return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
}

/// 'a b.xy' and "a b.xy" mean a b.xy: no path needs quotes, but many people write them.
std::string without_quotes(const std::string& value) {
  const std::size_t n = value.size();
  const bool are = n > 2 && (value[0] == '"' || value[0] == '\'') && value[n - 1] == value[0];
  return are ? value.substr(1, n - 2) : value;
}

/// Sections of the table in which a key of this name exists, for "did you mean".
std::string other_home(const std::string& section, const std::string& key) {
  for (const Option& option : option_table())
    if (option.key == key && option.section != table_section(section))
      return fmt::format("; it belongs to [{}]", option.section);
  return "";
}

} // namespace

Settings::Settings(const IniDocument& document, Diagnostics& problems) {
  for (const IniEntry& entry : document.entries)
    lines_.emplace(IniKey{entry.section, entry.key}, entry.line);
  check_sections(document, problems);
  for (const IniEntry& entry : document.entries)
    if (is_known_section(entry.section))
      check_entry(entry, problems);
    else if (++misspelt_ <= most_misspelt)
      meant_.insert({nearest_section(entry.section), entry.key});
  for (const std::string& part : parts())
    check_part("shape." + part, problems);
  for (const std::string& curve : curves())
    check_given("curve." + curve, "file", problems);
  for (const std::string& field : fields())
    check_given("field." + field, "file", problems);
  for (const std::string& size : sizes())
    check_given("size." + size, "expression", problems);
}

/// The kind of named section to which a section belongs; null if it belongs to none.
const Settings::NamedSections* Settings::named(std::string_view section) const {
  for (const NamedSections& kind : named_)
    if (section.starts_with(kind.prefix))
      return &kind;
  return nullptr;
}

bool Settings::is_known_section(const std::string& section) const {
  if (const NamedSections* kind = named(section))
    return section != kind->section && kind->known.contains(section.substr(kind->prefix.size()));
  static const std::vector<std::string> known = section_names();
  return std::find(known.begin(), known.end(), section) != known.end();
}

void Settings::check_sections(const IniDocument& document, Diagnostics& problems) {
  for (const IniSection& section : document.sections) {
    section_lines_.emplace(section.name, section.line);
    if (named(section.name) == nullptr) {
      if (!is_known_section(section.name))
        add_unknown_section(section, problems);
      continue;
    }
    check_name(section, problems);
  }
}

/// The known section that is most similar to a misspelt one, such as "field.depth" for "fields.depth"; empty if no
/// section is similar.
std::string Settings::nearest_section(const std::string& section) const {
  const std::size_t dot = section.find('.');
  if (dot == std::string::npos)
    return nearest_name(section, section_names());
  std::vector<std::string> kinds;
  for (const NamedSections& kind : named_)
    kinds.emplace_back(kind.prefix.substr(0, kind.prefix.size() - 1));
  const std::string near = nearest_name(section.substr(0, dot), kinds);
  return near.empty() ? "" : near + section.substr(dot);
}

void Settings::add_unknown_section(const IniSection& section, Diagnostics& problems) {
  has_unknown_section_ = true;
  std::string near;
  if (++misspelt_ <= most_misspelt)
    near = nearest_section(section.name);
  problems.add(section.line, fmt::format("unknown section [{}]{}", shown(section.name),
                                         near.empty() ? "" : fmt::format("; did you mean '{}'?", shown(near))));
  const std::string_view prefix = named_[fields_at].prefix;
  if (const std::string name = near.starts_with(prefix) ? near.substr(prefix.size()) : "";
      is_part_name(name) && !is_word_of_formulas(name) && std::ranges::find(meant_fields_, name) == meant_fields_.end())
    meant_fields_.push_back(name);
}

/// The known key that is most similar to a misspelt one; if possible, one that the section does not set.
std::string Settings::nearest_key(const IniEntry& entry) const {
  std::vector<std::string> others = key_names(entry.section);
  const std::vector<std::string> all = others;
  std::erase_if(others, [&](const std::string& key) { return lines_.contains({entry.section, key}); });
  const std::string near = nearest_name(entry.key, others);
  return near.empty() ? nearest_name(entry.key, all) : near;
}

/// The name of a part, a region, a curve or a field.
void Settings::check_name(const IniSection& section, Diagnostics& problems) {
  NamedSections& kind = named_[static_cast<std::size_t>(named(section.name) - named_.data())];
  const std::string name = section.name.substr(kind.prefix.size());
  const auto is_other = [&](std::size_t other) {
    return &kind != &named_[other] && named_[other].known.contains(name);
  };
  if (std::find(reserved_names.begin(), reserved_names.end(), name) != reserved_names.end())
    problems.add(section.line,
                 fmt::format("'{}' cannot name a {}, because 'geometry' uses this word; choose another name",
                             shown(name), kind.what));
  else if (!is_part_name(name))
    problems.add(section.line,
                 fmt::format("'{}' cannot name a {}: use letters, digits and '_', and begin with a letter", shown(name),
                             kind.what));
  else if (&kind == &named_[fields_at] && is_word_of_formulas(name))
    problems.add(section.line, fmt::format("'{}' cannot name a field, because formulas use this word; choose another "
                                           "name",
                                           shown(name)));
  else if ((&kind == &named_[parts_at] || &kind == &named_[curves_at]) && (is_other(parts_at) || is_other(curves_at)))
    problems.add(section.line, fmt::format("'{}' names a part and a curve: expected different names", shown(name)));
  else if (kind.known.insert(name).second)
    kind.names.push_back(name);
}

void Settings::check_given(const std::string& section, const std::string& key, Diagnostics& problems) {
  if (!is_set(section, key))
    problems.add(section_line(section),
                 fmt::format("[{}] needs '{}': {}", shown(section), key, expectation(*find_option(section, key))));
}

void Settings::check_entry(const IniEntry& entry, Diagnostics& problems) {
  const Option* option = find_option(entry.section, entry.key);
  if (!option) {
    std::string near;
    if (++misspelt_ <= most_misspelt) {
      near = nearest_key(entry);
      meant_.insert({entry.section, near});
    }
    problems.add(entry.line, fmt::format("unknown key '{}' in [{}]{}", shown(entry.key), shown(entry.section),
                                         near.empty() ? other_home(entry.section, entry.key)
                                                      : fmt::format("; did you mean '{}'?", near)));
    return;
  }
  IniEntry meant = entry;
  if (option->kind == OptionKind::path)
    meant.value = without_quotes(entry.value);
  const std::string problem = value_problem(*option, entry.section, meant.value);
  if (problem.empty())
    keep(meant);
  else
    problems.add(entry.line, problem);
}

void Settings::keep(const IniEntry& entry) {
  good_.emplace(IniKey{entry.section, entry.key}, entry.value);
  own_[entry.section].push_back(entry);
}

/// The keys of a part against its type. A line that was refused already is not reported again.
void Settings::check_part(const std::string& section, Diagnostics& problems) {
  if (!is_set(section, "type")) {
    problems.add(section_line(section),
                 fmt::format("[{}] needs a type: {}", shown(section), expectation(*find_option(section, "type"))));
    return;
  }
  const std::string type = text(section, "type");
  if (type.empty())
    return;
  for (const IniEntry& entry : own_[section]) {
    const Option* option = find_option(section, entry.key);
    bool belongs = *option->part_type == '\0';
    for (const Option& other : option_table()) // x_min stands in the table once per type that has it
      belongs = belongs || (other.section == part_section && other.key == entry.key && other.part_type == type);
    if (!belongs)
      problems.add(entry.line, fmt::format("'{}' in [{}] belongs to type {}, but the type is {}", entry.key,
                                           shown(section), option->part_type, type));
  }
  for (const Option& option : option_table())
    if (option.section == part_section && option.part_type == type && *option.fallback == '\0' &&
        !is_set(section, option.key))
      problems.add(section_line(section), fmt::format("[{}] of type {} needs '{}': {}", shown(section), type,
                                                      option.key, expectation(option)));
}

int Settings::section_line(const std::string& section) const {
  const auto found = section_lines_.find(section);
  return found == section_lines_.end() ? whole_file : found->second;
}

bool Settings::is_set(const std::string& section, const std::string& key) const {
  return lines_.contains({section, key}) || meant_.contains({section, key});
}

bool Settings::was_refused(const std::string& section, const std::string& key) const {
  return is_set(section, key) && !good_.contains({section, key});
}

int Settings::line(const std::string& section, const std::string& key) const {
  const auto found = lines_.find({section, key});
  return found == lines_.end() ? whole_file : found->second;
}

int Settings::later_line(const std::string& section, const std::string& a, const std::string& b) const {
  const int first = line(section, a), second = line(section, b);
  const bool overridden = first == command_line_origin || second == command_line_origin;
  return overridden ? command_line_origin : std::max(first, second);
}

std::string Settings::text(const std::string& section, const std::string& key) const {
  if (const auto found = good_.find({section, key}); found != good_.end())
    return found->second;
  const Option* option = find_option(section, key);
  TRIME_ASSERT(option != nullptr, "[{}] {} is not in the option table", section, key);
  return option->fallback;
}

std::optional<double> Settings::optional_number(const std::string& section, const std::string& key) const {
  return parse_number(text(section, key));
}

std::optional<std::int64_t> Settings::optional_integer(const std::string& section, const std::string& key) const {
  return parse_integer(text(section, key));
}

double Settings::number(const std::string& section, const std::string& key) const {
  return optional_number(section, key).value_or(0);
}

std::int64_t Settings::integer(const std::string& section, const std::string& key) const {
  return optional_integer(section, key).value_or(0);
}

bool Settings::boolean(const std::string& section, const std::string& key) const {
  return parse_boolean(text(section, key)).value_or(false);
}

geometry::Vec2 Settings::pair(const std::string& section, const std::string& key) const {
  return parse_pair(text(section, key)).value_or(geometry::Vec2{});
}

std::string Settings::resolved(const std::string& directory) const {
  namespace fs = std::filesystem;
  std::string result;
  const auto section_text = [&](const std::string& section) {
    result += fmt::format("{}[{}]\n", result.empty() ? "" : "\n", section);
    const std::string type = section.starts_with(named_[parts_at].prefix) ? text(section, "type") : "";
    for (const Option& option : option_table()) {
      if (option.section != table_section(section) || (*option.part_type != '\0' && option.part_type != type))
        continue;
      std::string value = text(section, option.key);
      const bool from_config = named(section) != nullptr || option.section == std::string_view("meshing");
      if (option.kind == OptionKind::path && from_config && value != option.fallback)
        value = fs::absolute(fs::path(directory) / value).lexically_normal().string();
      result +=
          value.empty() ? fmt::format("; {} is not set\n", option.key) : fmt::format("{} = {}\n", option.key, value);
    }
  };
  for (const std::string& section : section_names()) {
    const NamedSections* kind = named(section);
    if (kind == nullptr)
      section_text(section);
    else
      for (const std::string& name : kind->names)
        section_text(std::string(kind->prefix) + name);
  }
  return result;
}

} // namespace trime::app
