// SPDX-License-Identifier: BSD-3-Clause
// Sections and keys of a config, and files of points.
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
  /// @param folder what relative paths are relative to
  ConfigText(const std::string& text, std::string folder);

  /// Names of the parts, sections [shape.NAME], in their order.
  const std::vector<std::string>& parts() const { return parts_; }
  /// The value; empty if the key is not there or its value is `auto` or `none`.
  std::string value(const std::string& section, const std::string& key) const;
  std::optional<double> number(const std::string& section, const std::string& key) const;
  bool is_true(const std::string& section, const std::string& key) const { return value(section, key) == "true"; }
  /// @throws Failure (exit 2) if it is not there or no two numbers
  Point point(const std::string& section, const std::string& key) const;
  std::string path(const std::string& section, const std::string& key) const;

private:
  std::map<std::pair<std::string, std::string>, std::string> values_;
  std::vector<std::string> parts_;
  std::string folder_;
};

/// The text of a file, unless it cannot be read.
std::optional<std::string> read_text(const std::string& path);

using Ring = std::vector<Point>;
/// @brief Rings of a file of `x y` lines: a blank line or one with `>` ends a ring, `#` starts a comment, a first line
/// without numbers is left out.
std::vector<Ring> read_rings(const std::string& text);

} // namespace trime_check
