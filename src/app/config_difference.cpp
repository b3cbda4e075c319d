// SPDX-License-Identifier: BSD-3-Clause
#include "app/config_difference.hpp"

#include "app/ini.hpp"
#include "app/option_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace trime::app {
namespace {

using Keys = std::map<std::pair<std::string, std::string>, std::string>; // by section and key

/// Keys that may change the mesh.
Keys keys_of(const std::string& config) {
  constexpr const char* others[] = {"parallel", "output", "checkpoint", "log"};
  Diagnostics problems("checkpoint");
  Keys keys;
  for (const IniEntry& entry : parse_ini(config, problems).entries) {
    const Option* option = find_option(table_section(entry.section), entry.key);
    if (std::find(std::begin(others), std::end(others), entry.section) == std::end(others) &&
        !(option && option->kind == OptionKind::path))
      keys[{entry.section, entry.key}] = entry.value;
  }
  return keys;
}

} // namespace

std::vector<std::string> differing_keys(const std::string& then, const std::string& now) {
  const Keys old_keys = keys_of(then), new_keys = keys_of(now);
  std::vector<std::string> lines;
  const auto value_in = [](const Keys& keys, const Keys::key_type& key) {
    const auto found = keys.find(key);
    return found == keys.end() ? std::string("nothing") : found->second;
  };
  Keys all = old_keys;
  all.insert(new_keys.begin(), new_keys.end());
  for (const auto& [key, value] : all)
    if (const std::string was = value_in(old_keys, key), is = value_in(new_keys, key); was != is)
      lines.push_back(fmt::format("{} in [{}]: {} then, {} now", key.second, key.first, was, is));
  return lines;
}

} // namespace trime::app
