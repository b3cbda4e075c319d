// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/cone_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::sizing {

using geometry::Vec2;

namespace {

constexpr std::size_t leaf_size = 8; // cones, at most

bool before(const Cone& a, const Cone& b, bool by_x) {
  const Vec2 p = by_x ? a.apex : Vec2{a.apex.y, a.apex.x}, q = by_x ? b.apex : Vec2{b.apex.y, b.apex.x};
  return p == q ? a.height < b.height : geometry::lexicographically_less(p, q);
}

} // namespace

double ConeTree::Node::lower_bound(Vec2 p, double slope) const {
  return slope * std::sqrt(box.squared_distance(p)) + least;
}

ConeTree::ConeTree(std::vector<Cone> cones, double slope)
    : cones_(std::move(cones)), slope_(slope), inverse_slope_(1 / slope) {
  if (cones_.empty())
    return;
  leaves_ = 1;
  while (leaves_ * leaf_size < cones_.size())
    leaves_ *= 2;
  nodes_.resize(2 * leaves_);
  sort(1, 0, leaves_);
}

void ConeTree::sort(std::size_t node, std::size_t first_leaf, std::size_t last_leaf) {
  const auto at = [&](std::size_t leaf) { return cones_.begin() + static_cast<std::ptrdiff_t>(first_of(leaf)); };
  const auto first = at(first_leaf), last = at(last_leaf);
  Node& here = nodes_[node];
  for (auto cone = first; cone != last; ++cone) {
    here.box.include(cone->apex);
    here.least = std::min(here.least, cone->height);
  }
  if (last_leaf - first_leaf == 1)
    return;
  const std::size_t middle = (first_leaf + last_leaf) / 2;
  const bool by_x = here.box.width() >= here.box.height();
  std::nth_element(first, at(middle), last, [by_x](const Cone& a, const Cone& b) { return before(a, b, by_x); });
  sort(2 * node, first_leaf, middle);
  sort(2 * node + 1, middle, last_leaf);
}

/// Roots are taken for those cones only that are lower than all before; the nearer box comes first.
ConeTree::Found ConeTree::find(Vec2 p, double bound, double slack) const {
  Found found{bound, cones_.size()};
  if (cones_.empty())
    return found;
  // Squared distance within which a cone of this height is lower than the bound; negative if none is.
  const auto squared_reach = [this](double height, double below) {
    const double reach = (below - height) * inverse_slope_;
    return reach > 0 ? reach * reach : -1;
  };
  struct Entry {
    std::size_t node;
    double squared_distance;
  };
  std::array<Entry, 64> stack; // deeper than any tree in memory
  std::size_t size = 0;
  const double share = 1 / (1 + slack);
  stack[size++] = {1, nodes_[1].box.squared_distance(p)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared_distance >= squared_reach(nodes_[entry.node].least, found.value * share))
      continue;
    if (entry.node >= leaves_) {
      const std::size_t leaf = entry.node - leaves_, last = first_of(leaf + 1);
      for (std::size_t k = first_of(leaf); k < last; ++k)
        if (squared_length(p - cones_[k].apex) < squared_reach(cones_[k].height, found.value))
          if (const double value = cones_[k].value(p, slope_); value < found.value)
            found = {value, k};
      continue;
    }
    Entry near{2 * entry.node, nodes_[2 * entry.node].box.squared_distance(p)};
    Entry far{2 * entry.node + 1, nodes_[2 * entry.node + 1].box.squared_distance(p)};
    if (far.squared_distance < near.squared_distance)
      std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return found;
}

double ConeTree::value(Vec2 p, double bound, double slack) const {
  return find(p, bound, slack).value;
}

LocalIndex ConeTree::lowest(Vec2 p, double bound) const {
  const std::size_t cone = find(p, bound, 0).cone;
  return cone < cones_.size() ? static_cast<LocalIndex>(cone) : -1;
}

void ConeTree::collect(Vec2 p, double bound, std::vector<LocalIndex>& found) const {
  if (cones_.empty())
    return;
  std::array<std::size_t, 64> stack;
  std::size_t size = 0;
  stack[size++] = 1;
  while (size > 0) {
    const std::size_t node = stack[--size];
    if (!(nodes_[node].lower_bound(p, slope_) <= bound))
      continue;
    if (node < leaves_) {
      stack[size++] = 2 * node + 1;
      stack[size++] = 2 * node;
      continue;
    }
    const std::size_t last = first_of(node - leaves_ + 1);
    for (std::size_t k = first_of(node - leaves_); k < last; ++k)
      if (cones_[k].value(p, slope_) <= bound)
        found.push_back(static_cast<LocalIndex>(k));
  }
}

} // namespace trime::sizing
