// SPDX-License-Identifier: BSD-3-Clause
// Reads sections and keys of a config, and files of points.
#pragma once

#include "mesh.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trime_check {

/// `[section] key = value`; a comment starts with `;` or `#` at the start of a line or after a blank.
class ConfigText {
public:
  /// @param folder the folder to which relative paths refer
  ConfigText(const std::string& text, std::string folder);

  /// Names of the parts, which are the sections [shape.NAME], in their order.
  const std::vector<std::string>& parts() const { return parts_; }
  /// Returns the value; empty if the key is missing or its value is `auto` or `none`.
  std::string value(const std::string& section, const std::string& key) const;
  std::optional<double> number(const std::string& section, const std::string& key) const;
  bool is_true(const std::string& section, const std::string& key) const { return value(section, key) == "true"; }
  /// @throws Failure (exit 2) if the value is missing or is not two numbers
  Point point(const std::string& section, const std::string& key) const;
  std::string path(const std::string& section, const std::string& key) const;

private:
  std::map<std::pair<std::string, std::string>, std::string> values_;
  std::vector<std::string> parts_;
  std::string folder_;
};

/// Returns the text of a file, or nothing if it cannot be read.
std::optional<std::string> read_text(const std::string& path);

using Ring = std::vector<Point>;
/// @brief Returns the rings of a file of `x y` lines. A blank line or one with `>` ends a ring, `#` starts a comment,
/// and a first line without numbers is skipped.
std::vector<Ring> read_rings(const std::string& text);

} // namespace trime_check
