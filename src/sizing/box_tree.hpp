// SPDX-License-Identifier: BSD-3-Clause
// A hierarchy of boxes over a sequence of items whose neighbours lie close together, eight at a time.
#pragma once

#include "core/lanes.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

namespace trime::sizing {

/// @brief Runs of eight items are leaves, eight leaves a node, and so on. Each box has a number, the least of its
/// items. Immutable; searches are thread-safe.
class BoxTree {
public:
  static constexpr std::size_t width = 8;
  using Lanes = lanes::Types<2>::Doubles;

  static Lanes load(const std::array<double, width>& values, std::size_t first) {
    Lanes v;
    std::memcpy(&v, &values[first], sizeof v);
    return v;
  }

  BoxTree() = default;
  /// @param box_of, number_of of item k, called once for each in rising order. O(n).
  template <class BoxOf, class NumberOf>
  BoxTree(std::size_t items, const BoxOf& box_of, const NumberOf& number_of);

  /// @brief Depth first, the nearest box first: visit(first, last) for the items of leaves whose box is nearer to p
  /// than the root of limit(number), given and taken for two boxes at once. The limit may fall while items are visited.
  template <class Limit, class Visit>
  void search(geometry::Vec2 p, const Limit& limit, const Visit& visit) const;

  /// visit(k) for all items, in their order, but for those in boxes with skip(box, number).
  template <class Skip, class Visit>
  void visit_unless(const Skip& skip, const Visit& visit) const {
    if (!levels_.empty())
      visit_unless(levels_.size() - 1, 0, skip, visit);
  }

private:
  /// The boxes below a node; those that are missing are infinitely far away.
  struct alignas(64) Node {
    std::array<double, width> min_x, min_y, max_x, max_y, number;
  };
  struct Entry {
    std::size_t level, node;
    double squared_distance, number;
  };
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static void include(Node& node, std::size_t child, const geometry::Box& box, double number);

  template <class Skip, class Visit>
  void visit_unless(std::size_t level, std::size_t node, const Skip& skip, const Visit& visit) const;

  std::size_t items_ = 0;
  std::vector<std::vector<Node>> levels_; ///< from the leaves to the root
};

inline void BoxTree::include(Node& node, std::size_t child, const geometry::Box& box, double number) {
  node.min_x[child] = std::min(node.min_x[child], box.min.x);
  node.min_y[child] = std::min(node.min_y[child], box.min.y);
  node.max_x[child] = std::max(node.max_x[child], box.max.x);
  node.max_y[child] = std::max(node.max_y[child], box.max.y);
  node.number[child] = std::min(node.number[child], number);
}

template <class BoxOf, class NumberOf>
BoxTree::BoxTree(std::size_t items, const BoxOf& box_of, const NumberOf& number_of) : items_(items) {
  if (items == 0)
    return;
  Node none;
  for (std::array<double, width>* values : {&none.min_x, &none.min_y, &none.number})
    values->fill(infinity);
  for (std::array<double, width>* values : {&none.max_x, &none.max_y})
    values->fill(-infinity);
  const auto nodes_of = [](std::size_t boxes) { return (boxes + width - 1) / width; };
  std::size_t boxes = nodes_of(items);
  levels_.emplace_back(nodes_of(boxes), none);
  for (std::size_t k = 0; k < items; ++k)
    include(levels_[0][k / (width * width)], k / width % width, box_of(k), number_of(k));
  while (levels_.back().size() > 1) {
    std::vector<Node> above(nodes_of(levels_.back().size()), none);
    for (std::size_t k = 0; k < levels_.back().size(); ++k) {
      const Node& node = levels_.back()[k];
      for (std::size_t child = 0; child < width; ++child)
        include(above[k / width], k % width,
                {{node.min_x[child], node.min_y[child]}, {node.max_x[child], node.max_y[child]}}, node.number[child]);
    }
    levels_.push_back(std::move(above));
  }
}

template <class Limit, class Visit>
void BoxTree::search(geometry::Vec2 p, const Limit& limit, const Visit& visit) const {
  if (levels_.empty())
    return;
  std::array<Entry, width * 16> stack; // deeper than any tree in memory
  std::size_t size = 0;
  stack[size++] = {levels_.size(), 0, 0, -infinity};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (!(entry.squared_distance < limit(Lanes{entry.number, entry.number})[0]))
      continue;
    if (entry.level == 0) {
      const std::size_t first = entry.node * width;
      visit(first, std::min(items_, first + width));
      continue;
    }
    const Node& node = levels_[entry.level - 1][entry.node];
    const std::size_t bottom = size;
    for (std::size_t child = 0; child < width; child += 2) {
      const Lanes dx =
          lanes::larger(lanes::larger(load(node.min_x, child) - p.x, p.x - load(node.max_x, child)), Lanes{});
      const Lanes dy =
          lanes::larger(lanes::larger(load(node.min_y, child) - p.y, p.y - load(node.max_y, child)), Lanes{});
      const Lanes squared = dx * dx + dy * dy, number = load(node.number, child);
      const unsigned near = lanes::bits(squared < limit(number));
      for (unsigned k = 0; k < 2; ++k)
        if ((near >> k & 1) != 0) {
          stack[size++] = {entry.level - 1, entry.node * width + child + k, squared[k], number[k]};
          if (size > bottom + 1 && stack[size - 1].squared_distance > stack[size - 2].squared_distance)
            std::swap(stack[size - 1], stack[size - 2]); // the nearest stays on top
        }
    }
  }
}

template <class Skip, class Visit>
void BoxTree::visit_unless(std::size_t level, std::size_t node, const Skip& skip, const Visit& visit) const {
  const Node& here = levels_[level][node];
  for (std::size_t child = 0; child < width; ++child) {
    if (!(here.min_x[child] <= here.max_x[child]))
      return;
    if (skip(geometry::Box{{here.min_x[child], here.min_y[child]}, {here.max_x[child], here.max_y[child]}},
             here.number[child]))
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
