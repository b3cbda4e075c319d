// SPDX-License-Identifier: BSD-3-Clause
#include "cones/box_tree.hpp"

namespace trime::cones {

BoxNode BoxTree::empty_node() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  BoxNode node;
  for (std::size_t k = 0; k < width; ++k) {
    node.min_x[k] = node.min_y[k] = node.number[k] = infinity;
    node.max_x[k] = node.max_y[k] = -infinity;
  }
  return node;
}

void BoxTree::set_child(BoxNode& node, std::size_t child, const Item& item) {
  node.min_x[child] = item.box.min.x;
  node.min_y[child] = item.box.min.y;
  node.max_x[child] = item.box.max.x;
  node.max_y[child] = item.box.max.y;
  node.number[child] = item.number;
}

BoxTree::Item BoxTree::child_of(const BoxNode& node, std::size_t child) {
  return {{{node.min_x[child], node.min_y[child]}, {node.max_x[child], node.max_y[child]}}, node.number[child]};
}

void BoxTree::add_levels() {
  while (levels_.back().size() > 1) {
    const std::vector<BoxNode>& below = levels_.back();
    std::vector<BoxNode> above((below.size() + width - 1) / width, empty_node());
    for (std::size_t k = 0; k < below.size(); ++k) {
      Item all = nothing;
      for (std::size_t child = 0; child < width; ++child)
        include(all, child_of(below[k], child));
      set_child(above[k / width], k % width, all);
    }
    levels_.push_back(std::move(above));
  }
  for (const std::vector<BoxNode>& nodes : levels_)
    pointers_.nodes[pointers_.count++] = nodes.data();
}

} // namespace trime::cones
