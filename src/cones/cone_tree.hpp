// SPDX-License-Identifier: BSD-3-Clause
// A hierarchy of boxes over a sequence of items, eight at a time, where consecutive items lie close together. ConeTree
// uses it to find the lower envelope of cones with one slope, min over k of slope |x - apex_k| + height_k, by branch
// and bound. With slope 1 this finds the nearest apex: with additive weights, or (if all heights are 0) without.
#pragma once

#include "cones/cone_kernel.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace trime::cones {

/// @brief A tree over items: each eight items form a leaf, eight leaves a node, eight nodes a node of the next level.
/// Each box stores the smallest number of its items. Immutable; searches are thread-safe.
class BoxHierarchy {
public:
  static constexpr std::size_t width = box_width;

  /// The box and the number of an item, from which the tree is built.
  struct Item {
    geometry::Box box;
    double number;
  };

  BoxHierarchy() = default;
  BoxHierarchy(BoxHierarchy&&) = default;
  BoxHierarchy& operator=(BoxHierarchy&&) = default;
  /// Builds the tree. O(n), by all threads.
  /// @param item_of item_of(k) returns item k; thread-safe
  template <class ItemOf>
  BoxHierarchy(std::size_t items, const ItemOf& item_of);

  /// Returns the levels of the tree. The pointers in the levels stay valid when the tree is moved.
  const BoxLevels& levels() const { return pointers_; }
  std::size_t memory_bytes() const {
    std::size_t nodes = 0;
    for (const std::vector<BoxNode>& level : levels_)
      nodes += level.capacity();
    return nodes * sizeof(BoxNode);
  }

  /// Calls visit(k) for all items in their order, but skips boxes for which skip(box, number) is true.
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
  std::vector<std::vector<BoxNode>> levels_; ///< nodes of each level, from the one above the leaves up to the root
  BoxLevels pointers_;                       ///< pointers to the nodes of levels_, for the kernels
};

inline void BoxHierarchy::include(Item& all, const Item& item) {
  all.box.min.x = std::min(all.box.min.x, item.box.min.x);
  all.box.min.y = std::min(all.box.min.y, item.box.min.y);
  all.box.max.x = std::max(all.box.max.x, item.box.max.x);
  all.box.max.y = std::max(all.box.max.y, item.box.max.y);
  all.number = std::min(all.number, item.number);
}

template <class ItemOf>
BoxHierarchy::BoxHierarchy(std::size_t items, const ItemOf& item_of) : items_(items) {
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
void BoxHierarchy::visit_unless(std::size_t level, std::size_t node, const Skip& skip, const Visit& visit) const {
  for (std::size_t child = 0; child < width; ++child) {
    const Item item = child_of(levels_[level][node], child);
    if (!(item.box.min.x <= item.box.max.x))
      return; // the remaining boxes are unused
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

struct Cone {
  geometry::Vec2 apex;
  double height;

  double value(geometry::Vec2 p, double slope) const { return slope * geometry::length(p - apex) + height; }
};

/// Finds the lowest of many cones at a point. Immutable; queries are thread-safe.
class ConeTree {
public:
  ConeTree() = default;
  /// Builds the tree in O(n) time. Memory: about 60 bytes per cone.
  ConeTree(const std::vector<Cone>& cones, double slope);

  /// @brief Returns the smallest of `bound` and the values of all cones at p. A low bound makes the search faster.
  /// Takes O(log n) time for points near a few cones.
  /// @param slack relative error by which the result may be too high; it saves time where many cones are almost equally
  /// low
  double value(geometry::Vec2 p, double bound = std::numeric_limits<double>::infinity(), double slack = 0) const;

  /// Returns the index of the cone that is lowest at p, or -1 if no cone is below `bound` there.
  LocalIndex lowest(geometry::Vec2 p, double bound) const;

  /// Calls visit(index) for the cones in the order of the tree, but skips nodes for which skip(box, least) is true.
  /// `box` contains the apexes of the node's cones, and `least` is the smallest of their heights.
  template <class Skip, class Visit>
  void visit_unless(const Skip& skip, const Visit& visit) const {
    tree_.visit_unless(skip, [&](std::size_t k) { visit(static_cast<LocalIndex>(k)); });
  }

  /// Appends to `found` the indices of all cones whose value at p is at most `bound`, in the order of the tree.
  void collect(geometry::Vec2 p, double bound, std::vector<LocalIndex>& found) const;

  /// Returns the cones in the order of the tree.
  std::span<const Cone> cones() const { return cones_; }
  std::size_t memory_bytes() const {
    return cones_.capacity() * sizeof(Cone) + leaves_.capacity() * sizeof(ConeLeaf) + tree_.memory_bytes();
  }

private:
  LowestCone find(geometry::Vec2 p, double bound, double slack) const;

  std::vector<Cone> cones_;      // ordered along a Hilbert curve
  std::vector<ConeLeaf> leaves_; // all cones, eight at a time
  BoxHierarchy tree_;            // boxes around apexes, with the smallest height of each box
  double slope_ = 1;
  SearchKernel kernel_ = search_kernel(simd_level());
};

} // namespace trime::cones
