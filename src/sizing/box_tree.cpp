// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/box_tree.hpp"

#include <limits>

namespace trime::sizing {

BoxNode BoxTree::empty_node() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  BoxNode node;
  for (std::size_t k = 0; k < width; ++k) {
    node.min_x[k] = node.min_y[k] = node.number[k] = infinity;
    node.max_x[k] = node.max_y[k] = -infinity;
  }
  return node;
}

void BoxTree::include(BoxNode& node, std::size_t child, const Item& item) {
  node.min_x[child] = std::min(node.min_x[child], item.box.min.x);
  node.min_y[child] = std::min(node.min_y[child], item.box.min.y);
  node.max_x[child] = std::max(node.max_x[child], item.box.max.x);
  node.max_y[child] = std::max(node.max_y[child], item.box.max.y);
  node.number[child] = std::min(node.number[child], item.number);
}

BoxTree::Item BoxTree::child_of(const BoxNode& node, std::size_t child) {
  return {{{node.min_x[child], node.min_y[child]}, {node.max_x[child], node.max_y[child]}}, node.number[child]};
}

void BoxTree::add_levels() {
  while (levels_.back().size() > 1) {
    const std::vector<BoxNode>& below = levels_.back();
    std::vector<BoxNode> above((below.size() + width - 1) / width, empty_node());
    for (std::size_t k = 0; k < below.size(); ++k)
      for (std::size_t child = 0; child < width; ++child)
        include(above[k / width], k % width, child_of(below[k], child));
    levels_.push_back(std::move(above));
  }
}

BoxLevels BoxTree::levels() const {
  BoxLevels levels;
  for (const std::vector<BoxNode>& nodes : levels_)
    levels.nodes[levels.count++] = nodes.data();
  return levels;
}

} // namespace trime::sizing
