// SPDX-License-Identifier: BSD-3-Clause
// Reads sections and keys of a config, and files of points.
#pragma once

#include "mesh.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace trime_check {

/// The text of a config with lines `[section]` and `key = value`. A comment starts with `;` or `#`, at the start of a
/// line or after a blank.
class ConfigText {
public:
  /// @param folder folder relative to which paths in the config are read
  ConfigText(const std::string& text, std::string folder);

  /// The names of the parts in the order of their sections [shape.NAME].
  const std::vector<std::string>& parts() const { return parts_; }
  /// The names of the regions in the order of their sections [region.NAME].
  const std::vector<std::string>& regions() const { return regions_; }
  /// Returns the value of a key; empty if the key is missing or its value is `auto` or `none`.
  std::string value(const std::string& section, const std::string& key) const;
  /// Returns whether the key has a value other than `none`; it may be `auto`.
  bool has(const std::string& section, const std::string& key) const;
  /// Returns whether a section begins with this text, such as `size.`.
  bool has_section(const std::string& beginning) const;
  std::optional<double> number(const std::string& section, const std::string& key) const;
  bool is_true(const std::string& section, const std::string& key) const { return value(section, key) == "true"; }
  /// @throws Failure (exit 2) if the value is missing or is not two numbers
  Point point(const std::string& section, const std::string& key) const;
  std::string path(const std::string& section, const std::string& key) const;

private:
  std::map<std::pair<std::string, std::string>, std::string> values_;
  std::vector<std::string> parts_, regions_;
  std::string folder_;
};

/// Returns whether a region has the key `size`.
bool has_region_sizes(const ConfigText& config);

/// Returns the text of a file, or nothing if it cannot be read.
std::optional<std::string> read_text(const std::string& path);

using Ring = std::vector<Point>;
/// @brief Returns the rings of a file with lines `x y`. A blank line or a line with `>` ends a ring, `#` starts a
/// comment, and a first line without numbers is skipped.
std::vector<Ring> read_rings(const std::string& text);

/// The number of each part by its name.
using PartNumbers = std::unordered_map<std::string, std::size_t>;

/// @brief The region formula of a config. It says whether a place that lies in some of the parts lies in the region. If
/// the place enters or leaves one part, the update costs O(depth of the tree).
class Region {
public:
  static constexpr std::size_t none = ~std::size_t{0};
  enum class Kind { part, unite, intersect, subtract };
  struct Node {
    Kind kind = Kind::part;
    std::size_t part = none;           ///< number of the part, for a leaf
    std::size_t parent = none;         ///< number of the parent, which comes after all its children
    bool is_first = false;             ///< first child of its parent
    std::size_t children = 0, set = 0; ///< `set`: number of children that contain the place; for a leaf, 1 or 0
    bool first_is_set = false;
  };

  /// @throws Failure (exit 2) if the text is not a region of these parts
  Region(const std::string& text, const PartNumbers& parts);

  /// Sets whether the place lies in this part. At the beginning it lies in no part.
  void set(std::size_t part, bool inside);
  bool uses(std::size_t part) const { return leaves_.contains(part); }
  bool contains() const { return holds(nodes_.back()); }
  /// The nodes of the formula: children come before their parents, and the last node is the root.
  const std::vector<Node>& nodes() const { return nodes_; }

private:
  static bool holds(const Node& node);

  std::vector<Node> nodes_;
  std::unordered_map<std::size_t, std::vector<std::size_t>> leaves_; // by part: its leaves
};

} // namespace trime_check
