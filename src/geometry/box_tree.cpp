// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/box_tree.hpp"

#include <algorithm>

namespace trime::geometry {

BoxTree::BoxTree(std::span<const Box> boxes) {
  for (std::size_t k = 0; k < boxes.size(); ++k)
    items_.push_back({boxes[k], k});
  std::size_t leaves = 1; // ranges of one depth differ by one item at most
  while (leaves * run_length < items_.size())
    leaves *= 2;
  nodes_.resize(2 * leaves);
  if (!items_.empty())
    build(1, {0, items_.size()});
}

void BoxTree::build(std::size_t node, Range range) {
  Box whole, centers; // the latter twice as large
  for (std::size_t k = range.low; k < range.high; ++k) {
    whole = united(whole, items_[k].box);
    centers.include(items_[k].box.min + items_[k].box.max);
  }
  nodes_[node] = whole;
  if (range.high - range.low <= run_length)
    return;
  const bool by_y = centers.height() > centers.width();
  const auto less = [by_y](const Item& a, const Item& b) {
    const double u = by_y ? a.box.min.y + a.box.max.y : a.box.min.x + a.box.max.x;
    const double v = by_y ? b.box.min.y + b.box.max.y : b.box.min.x + b.box.max.x;
    return u < v || (u == v && a.index < b.index);
  };
  const auto at = [this](std::size_t k) { return items_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(range.low), at(range.middle()), at(range.high), less);
  build(2 * node, {range.low, range.middle()});
  build(2 * node + 1, {range.middle(), range.high});
}

std::vector<std::size_t> BoxTree::meeting(const Box& box) const {
  std::vector<std::size_t> found;
  for_each_meeting(box, [&](std::size_t k) { found.push_back(k); });
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace trime::geometry
