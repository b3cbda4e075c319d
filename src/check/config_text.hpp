// SPDX-License-Identifier: BSD-3-Clause
// Sections and keys of a config, files of points, and a region as a tree of unions, intersections and differences of
// parts.
#pragma once

#include "mesh.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
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

/// Numbers of parts by their names.
using PartNumbers = std::unordered_map<std::string, std::size_t>;

/// @brief Says whether a place lies in the region that is in some of the parts. A change of one part costs as much as
/// the tree is deep.
class Region {
public:
  static constexpr std::size_t none = ~std::size_t{0};
  enum class Kind { part, unite, intersect, subtract };
  struct Node {
    Kind kind = Kind::part;
    std::size_t part = none;           ///< of a leaf
    std::size_t parent = none;         ///< behind all its children
    bool is_first = false;             ///< of the children of its parent
    std::size_t children = 0, set = 0; ///< set: of the children, those that hold; of a leaf 1 or 0
    bool first_is_set = false;
  };

  /// @throws Failure (exit 2) if the text is no region of these parts
  Region(const std::string& text, const PartNumbers& parts);

  /// The place is in this part or out of it. At first it is in none.
  void set(std::size_t part, bool inside);
  bool uses(std::size_t part) const { return !leaves_[part].empty(); }
  bool contains() const { return holds(nodes_.back()); }
  /// Children before their parents; the last one is the root.
  const std::vector<Node>& nodes() const { return nodes_; }

private:
  static bool holds(const Node& node);

  std::vector<Node> nodes_;
  std::vector<std::vector<std::size_t>> leaves_; // of each part
};

} // namespace trime_check
