// SPDX-License-Identifier: BSD-3-Clause
// Represents a region as a tree of unions, intersections and differences of parts.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace trime_check {

/// Numbers of parts by their names.
using PartNumbers = std::unordered_map<std::string, std::size_t>;

/// @brief Says whether a place that lies in some of the parts lies in the region. Changing one part costs O(depth of
/// the tree).
class Region {
public:
  static constexpr std::size_t none = ~std::size_t{0};
  enum class Kind { part, unite, intersect, subtract };
  struct Node {
    Kind kind = Kind::part;
    std::size_t part = none;           ///< part of a leaf
    std::size_t parent = none;         ///< comes after all its children
    bool is_first = false;             ///< first child of its parent
    std::size_t children = 0, set = 0; ///< set counts the children that contain the place; for a leaf it is 1 or 0
    bool first_is_set = false;
  };

  /// @throws Failure (exit 2) if the text is not a region of these parts
  Region(const std::string& text, const PartNumbers& parts);

  /// Sets whether the place is in this part. At first it is in no part.
  void set(std::size_t part, bool inside);
  bool uses(std::size_t part) const { return !leaves_[part].empty(); }
  bool contains() const { return holds(nodes_.back()); }
  /// The nodes: children come before their parents, and the last node is the root.
  const std::vector<Node>& nodes() const { return nodes_; }

private:
  static bool holds(const Node& node);

  std::vector<Node> nodes_;
  std::vector<std::vector<std::size_t>> leaves_; // leaves of each part
};

} // namespace trime_check
