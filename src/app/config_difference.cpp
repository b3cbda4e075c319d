// SPDX-License-Identifier: BSD-3-Clause
#include "app/config_difference.hpp"

#include "app/ini.hpp"
#include "app/option_table.hpp"
#include "app/option_value.hpp"
#include "core/quoted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace trime::app {
namespace {

struct Value {
  std::string text;
  const Option* option; ///< null: a key of another program
};
using Keys = std::map<std::pair<std::string, std::string>, Value>; // by section and key

/// Keys that may change the mesh.
Keys keys_of(const std::string& config) {
  constexpr const char* others[] = {"parallel", "output", "checkpoint", "log"};
  Diagnostics problems("checkpoint");
  Keys keys;
  for (const IniEntry& entry : parse_ini(config, problems).entries) {
    const Option* option = find_option(table_section(entry.section), entry.key);
    if (std::find(std::begin(others), std::end(others), entry.section) == std::end(others) &&
        !(option && option->kind == OptionKind::path))
      keys[{entry.section, entry.key}] = {entry.value, option};
  }
  return keys;
}

/// Do two values mean the same, however they are written (6e3 is 6000)? A formula counts as its text.
bool is_same(const Value& a, const Value& b) {
  if (a.text == b.text || !a.option)
    return a.text == b.text;
  switch (a.option->kind) {
  case OptionKind::number:
  case OptionKind::integer: {
    const std::optional<double> was = parse_number(a.text), is = parse_number(b.text);
    return was && is && *was == *is;
  }
  case OptionKind::pair: {
    const std::optional<geometry::Vec2> was = parse_pair(a.text), is = parse_pair(b.text);
    return was && is && *was == *is;
  }
  default:
    return false;
  }
}

} // namespace

std::vector<std::string> differing_keys(const std::string& then, const std::string& now) {
  const Keys old_keys = keys_of(then), new_keys = keys_of(now);
  std::vector<std::string> lines;
  const auto value_in = [](const Keys& keys, const Keys::key_type& key) {
    const auto found = keys.find(key);
    return found == keys.end() ? Value{"nothing", nullptr} : found->second;
  };
  Keys all = old_keys;
  all.insert(new_keys.begin(), new_keys.end());
  for (const auto& [key, value] : all)
    if (const Value was = value_in(old_keys, key), is = value_in(new_keys, key); !is_same(was, is))
      lines.push_back(
          fmt::format("{} in [{}]: {} then, {} now", key.second, key.first, shown(was.text), shown(is.text)));
  return lines;
}

} // namespace trime::app
