// SPDX-License-Identifier: BSD-3-Clause
// Finds which of many boxes meet a given box, by a search tree.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace trime::geometry {

/// @brief A binary tree of boxes. Each node is divided along its longer side, so the tree is also fast for boxes along
/// one line. Immutable and thread-safe after construction.
class BoxTree {
public:
  BoxTree() = default;
  /// Builds the tree. Cost: O(n log n).
  /// @pre no box is empty, and all coordinates are finite
  explicit BoxTree(std::span<const Box> boxes);

  /// Calls visit(index) once for each box that meets `box`, in the order of the tree. Boxes are closed. Cost: O(log n +
  /// found) if few boxes overlap.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    if (!items_.empty())
      visit_node(1, {0, items_.size()}, box, visit);
  }
  /// Returns the indices of all boxes that meet `box`, in ascending order.
  std::vector<std::size_t> meeting(const Box& box) const;

private:
  struct Item {
    Box box;
    std::size_t index;
  };
  struct Range {
    std::size_t low, high;
    std::size_t middle() const { return low + (high - low) / 2; }
  };
  void build(std::size_t node, Range range);
  static bool meet(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
  }
  template <class Visit>
  void visit_node(std::size_t node, Range range, const Box& box, const Visit& visit) const {
    if (!meet(nodes_[node], box))
      return;
    if (range.high - range.low > run_length) {
      visit_node(2 * node, {range.low, range.middle()}, box, visit);
      visit_node(2 * node + 1, {range.middle(), range.high}, box, visit);
      return;
    }
    for (std::size_t k = range.low; k < range.high; ++k)
      if (meet(items_[k].box, box))
        visit(items_[k].index);
  }

  static constexpr std::size_t run_length = 4;
  std::vector<Item> items_;
  std::vector<Box> nodes_; // in the order of a heap: the root is 1, the children of k are 2k and 2k+1
};

} // namespace trime::geometry
