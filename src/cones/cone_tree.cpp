// SPDX-License-Identifier: BSD-3-Clause
#include "cones/cone_tree.hpp"

#include "core/hilbert.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace trime::cones {

BoxNode BoxHierarchy::empty_node() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  BoxNode node;
  for (std::size_t k = 0; k < width; ++k) {
    node.min_x[k] = node.min_y[k] = node.number[k] = infinity;
    node.max_x[k] = node.max_y[k] = -infinity;
  }
  return node;
}

void BoxHierarchy::set_child(BoxNode& node, std::size_t child, const Item& item) {
  node.min_x[child] = item.box.min.x;
  node.min_y[child] = item.box.min.y;
  node.max_x[child] = item.box.max.x;
  node.max_y[child] = item.box.max.y;
  node.number[child] = item.number;
}

BoxHierarchy::Item BoxHierarchy::child_of(const BoxNode& node, std::size_t child) {
  return {{{node.min_x[child], node.min_y[child]}, {node.max_x[child], node.max_y[child]}}, node.number[child]};
}

void BoxHierarchy::add_levels() {
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

using geometry::Vec2;

namespace {

constexpr int cones_in_a_row = 1024; // by one thread

constexpr int curve_level = 16; // 2^16 by 2^16 cells

/// A place along the curve, and the index of the cone.
struct Key {
  std::uint32_t place, index;
};

/// Sorts by place, digit by digit; keys of one place keep their order.
std::vector<Key> sorted(std::vector<Key> keys) {
  constexpr int digit_bits = 11;
  constexpr std::uint32_t digits = 1u << digit_bits;
  std::vector<Key> other(keys.size());
  for (int shift = 0; shift < 32; shift += digit_bits) {
    std::array<std::uint32_t, digits + 1> next{};
    for (const Key& key : keys)
      ++next[(key.place >> shift & (digits - 1)) + 1];
    for (std::uint32_t digit = 0; digit < digits; ++digit)
      next[digit + 1] += next[digit];
    for (const Key& key : keys)
      other[next[key.place >> shift & (digits - 1)]++] = key;
    keys.swap(other);
  }
  return keys;
}

/// In the order of a Hilbert curve through their box; cones in one of its cells keep their order.
std::vector<Cone> in_order(const std::vector<Cone>& cones) {
  geometry::Box box;
  for (const Cone& cone : cones)
    box.include(cone.apex);
  const double extent = std::max(box.width(), box.height());
  const double cells = extent > 1e-300 ? ((1 << curve_level) - 1) / extent : 0;
  std::vector<Key> keys(cones.size());
  thread_loop(std::ssize(cones), cones_in_a_row, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    const Vec2 place = cells * (cones[k].apex - box.min);
    keys[k] = {static_cast<std::uint32_t>(
                   hilbert_key(static_cast<std::uint32_t>(place.x), static_cast<std::uint32_t>(place.y), curve_level)),
               static_cast<std::uint32_t>(k)};
  });
  keys = sorted(std::move(keys));
  std::vector<Cone> ordered(cones.size());
  for (std::size_t k = 0; k < cones.size(); ++k)
    ordered[k] = cones[keys[k].index];
  return ordered;
}

} // namespace

ConeTree::ConeTree(const std::vector<Cone>& cones, double slope) : cones_(in_order(cones)), slope_(slope) {
  tree_ = BoxHierarchy(cones_.size(), [&](std::size_t k) {
    return BoxHierarchy::Item{{cones_[k].apex, cones_[k].apex}, cones_[k].height};
  });
  ConeLeaf none{};
  std::fill(std::begin(none.height), std::end(none.height), std::numeric_limits<double>::infinity());
  leaves_.resize((cones_.size() + BoxHierarchy::width - 1) / BoxHierarchy::width, none);
  thread_loop(std::ssize(cones_), cones_in_a_row, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    ConeLeaf& leaf = leaves_[k / BoxHierarchy::width];
    leaf.x[k % BoxHierarchy::width] = cones_[k].apex.x;
    leaf.y[k % BoxHierarchy::width] = cones_[k].apex.y;
    leaf.height[k % BoxHierarchy::width] = cones_[k].height;
  });
}

LowestCone ConeTree::find(Vec2 p, double bound, double slack) const {
  LowestCone lowest{bound, -1};
  kernel_.lowest(tree_.levels(), leaves_.data(), slope_, p.x, p.y, 1 / (1 + slack), lowest);
  return lowest;
}

double ConeTree::value(Vec2 p, double bound, double slack) const {
  return find(p, bound, slack).value;
}

LocalIndex ConeTree::lowest(Vec2 p, double bound) const {
  return static_cast<LocalIndex>(find(p, bound, 0).cone);
}

void ConeTree::collect(Vec2 p, double bound, std::vector<LocalIndex>& found) const {
  const auto above = [&](const geometry::Box& box, double least) {
    return !(slope_ * std::sqrt(box.squared_distance(p)) + least <= bound);
  };
  visit_unless(above, [&](LocalIndex k) {
    if (cones_[k].value(p, slope_) <= bound)
      found.push_back(k);
  });
}

} // namespace trime::cones
