// SPDX-License-Identifier: BSD-3-Clause
// A hierarchy of boxes over a sequence of items in which neighbours lie close together. A box contains eight items or
// eight boxes.
#pragma once

#include "cones/search_kernel.hpp"
#include "core/thread_loop.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace trime::cones {

/// @brief Each run of eight items is a leaf, eight leaves form a node, and so on. Each box stores the least number of
/// its items. Immutable; searches are thread-safe.
class BoxTree {
public:
  static constexpr std::size_t width = box_width;

  /// The data of an item in the tree.
  struct Item {
    geometry::Box box;
    double number;
  };

  BoxTree() = default;
  BoxTree(BoxTree&&) = default;
  BoxTree& operator=(BoxTree&&) = default;
  /// @param item_of(k) returns item k; it is thread-safe. O(n), by all threads.
  template <class ItemOf>
  BoxTree(std::size_t items, const ItemOf& item_of);

  /// The levels; their pointers stay valid when the tree is moved.
  const BoxLevels& levels() const { return pointers_; }
  std::size_t memory_bytes() const {
    std::size_t nodes = 0;
    for (const std::vector<BoxNode>& level : levels_)
      nodes += level.capacity();
    return nodes * sizeof(BoxNode);
  }

  /// Calls visit(k) for all items, in their order, except those in boxes with skip(box, number).
  template <class Skip, class Visit>
  void visit_unless(const Skip& skip, const Visit& visit) const {
    if (!levels_.empty())
      visit_unless(levels_.size() - 1, 0, skip, visit);
  }

private:
  static constexpr Item nothing{{}, std::numeric_limits<double>::infinity()};

  static BoxNode empty_node();
  static void include(Item& all, const Item& item);
  static void set_child(BoxNode& node, std::size_t child, const Item& item);
  static Item child_of(const BoxNode& node, std::size_t child);
  void add_levels();

  template <class Skip, class Visit>
  void visit_unless(std::size_t level, std::size_t node, const Skip& skip, const Visit& visit) const;

  std::size_t items_ = 0;
  std::vector<std::vector<BoxNode>> levels_; ///< from the nodes over leaves to the root
  BoxLevels pointers_;                       ///< pointers to levels_
};

inline void BoxTree::include(Item& all, const Item& item) {
  all.box.min.x = std::min(all.box.min.x, item.box.min.x);
  all.box.min.y = std::min(all.box.min.y, item.box.min.y);
  all.box.max.x = std::max(all.box.max.x, item.box.max.x);
  all.box.max.y = std::max(all.box.max.y, item.box.max.y);
  all.number = std::min(all.number, item.number);
}

template <class ItemOf>
BoxTree::BoxTree(std::size_t items, const ItemOf& item_of) : items_(items) {
  if (items == 0)
    return;
  constexpr int leaves_in_a_row = 64;
  std::vector<BoxNode>& nodes = levels_.emplace_back((items + width * width - 1) / (width * width), empty_node());
  thread_loop(static_cast<std::ptrdiff_t>((items + width - 1) / width), leaves_in_a_row, [&](std::ptrdiff_t n, int) {
    const auto leaf = static_cast<std::size_t>(n);
    Item all = nothing;
    for (std::size_t k = leaf * width; k < std::min(items, (leaf + 1) * width); ++k)
      include(all, item_of(k));
    set_child(nodes[leaf / width], leaf % width, all);
  });
  add_levels();
}

template <class Skip, class Visit>
void BoxTree::visit_unless(std::size_t level, std::size_t node, const Skip& skip, const Visit& visit) const {
  for (std::size_t child = 0; child < width; ++child) {
    const Item item = child_of(levels_[level][node], child);
    if (!(item.box.min.x <= item.box.max.x))
      return; // no items follow
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

} // namespace trime::cones
