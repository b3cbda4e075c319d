// SPDX-License-Identifier: BSD-3-Clause
// Which parts make the shape, and how: the expression of the config key `region`.
//   expression = name | union(e, e, ...) | intersection(e, e, ...) | difference(e, e, ...)
#pragma once

#include "trime/geometry/vec2.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trime::shape {

/// Name that stands for the container itself; no part may have it.
inline constexpr std::string_view domain_name = "domain";

/// A parsed expression over parts that are known by their index. Immutable.
class Region {
public:
  static constexpr int max_depth = 64; ///< largest depth of nested operations

  /// @brief Parses `text`; leaves refer to `part_names` by index, `domain` to the index part_names.size().
  /// @throws ConfigError with the position, or with the known names and the nearest one
  static Region parse(std::string_view text, std::span<const std::string> part_names);

  const std::string& text() const { return text_; }
  /// The indices of the parts that occur, ascending, each once.
  const std::vector<int>& parts() const { return parts_; }

  /// @brief Does the shape contain a point? inside(part index) must say whether the point lies in a part; it is called
  /// only as often as needed.
  template <class Inside>
  bool contains(const Inside& inside) const {
    return value(0, inside);
  }

  /// Returns a box around the shape, from the boxes of all parts and, after them, of the domain.
  geometry::Box box(std::span<const geometry::Box> boxes) const { return box_of(0, boxes); }

private:
  friend class RegionState;
  enum class Operation { part, unite, intersect, subtract };
  struct Node {
    Operation operation;
    int part;                  ///< leaves only
    std::vector<int> operands; ///< indices into nodes_
  };
  class Parser;

  template <class Inside>
  bool value(int node, const Inside& inside) const {
    const Node& n = nodes_[node];
    if (n.operation == Operation::part)
      return inside(n.part);
    // An operation is decided by the first operand with the deciding value; subtraction negates all but the first.
    const bool decides = n.operation == Operation::unite;
    for (std::size_t k = 0; k < n.operands.size(); ++k) {
      const bool negated = n.operation == Operation::subtract && k > 0;
      if ((value(n.operands[k], inside) != negated) == decides)
        return decides;
    }
    return !decides;
  }

  geometry::Box box_of(std::size_t node, std::span<const geometry::Box> boxes) const;

  std::string text_;
  std::vector<Node> nodes_; // the root first
  std::vector<int> parts_;
};

} // namespace trime::shape
