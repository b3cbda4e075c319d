// SPDX-License-Identifier: BSD-3-Clause
// A hierarchy of boxes over a sequence of items whose neighbours lie close together, eight at a time.
#pragma once

#include "sizing/search_kernel.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trime::sizing {

/// @brief Runs of eight items are leaves, eight leaves a node, and so on. Each box has a number, the least of its
/// items. Immutable; searches are thread-safe.
class BoxTree {
public:
  static constexpr std::size_t width = box_width;

  /// What the tree knows of an item.
  struct Item {
    geometry::Box box;
    double number;
  };

  BoxTree() = default;
  /// @param item_of(k) for the items in their order. O(n).
  template <class ItemOf>
  BoxTree(std::size_t items, const ItemOf& item_of);

  BoxLevels levels() const;

  /// visit(k) for all items, in their order, but for those in boxes with skip(box, number).
  template <class Skip, class Visit>
  void visit_unless(const Skip& skip, const Visit& visit) const {
    if (!levels_.empty())
      visit_unless(levels_.size() - 1, 0, skip, visit);
  }

private:
  static BoxNode empty_node();
  static void include(BoxNode& node, std::size_t child, const Item& item);
  static Item child_of(const BoxNode& node, std::size_t child);
  void add_levels();

  template <class Skip, class Visit>
  void visit_unless(std::size_t level, std::size_t node, const Skip& skip, const Visit& visit) const;

  std::size_t items_ = 0;
  std::vector<std::vector<BoxNode>> levels_; ///< from the nodes over leaves to the root
};

template <class ItemOf>
BoxTree::BoxTree(std::size_t items, const ItemOf& item_of) : items_(items) {
  if (items == 0)
    return;
  levels_.emplace_back((items + width * width - 1) / (width * width), empty_node());
  for (std::size_t k = 0; k < items; ++k)
    include(levels_[0][k / (width * width)], k / width % width, item_of(k));
  add_levels();
}

template <class Skip, class Visit>
void BoxTree::visit_unless(std::size_t level, std::size_t node, const Skip& skip, const Visit& visit) const {
  for (std::size_t child = 0; child < width; ++child) {
    const Item item = child_of(levels_[level][node], child);
    if (!(item.box.min.x <= item.box.max.x))
      return; // the last were before
    if (skip(item.box, item.number))
      continue;
    const std::size_t below = node * width + child;
    if (level > 0)
      visit_unless(level - 1, below, skip, visit);
    else
      for (std::size_t k = below * width; k < std::min(items_, (below + 1) * width); ++k)
        visit(k);
  }
}

} // namespace trime::sizing
