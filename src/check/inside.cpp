// SPDX-License-Identifier: BSD-3-Clause
#include "inside.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <tuple>

namespace trime_check {

double InsideTest::Side::x_at(double y) const {
  return y == b.y ? b.x : a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y);
}

bool InsideTest::Side::is_right_of(Point p) const {
  return p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y);
}

InsideTest::InsideTest(const std::vector<Ring>& rings) {
  for (const Ring& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      heights_.push_back(ring[k].y);
      if (const Side side{ring[k], ring[(k + 1) % ring.size()]}; side.a.y != side.b.y)
        sides_.push_back(side);
    }
  std::ranges::sort(heights_);
  heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
  leaves_ = std::bit_ceil(heights_.size() + 1);
  nodes_.resize(2 * leaves_);
  for (const Side& side : sides_)
    visit_nodes(side, [&](std::size_t node) { ++nodes_[node].end; });
  std::size_t total = 0;
  for (Node& node : nodes_) {
    const std::size_t count = node.end;
    node.begin = node.end = total;
    total += count;
  }
  order_.resize(total);
  for (std::size_t k = 0; k < sides_.size(); ++k)
    visit_nodes(sides_[k], [&](std::size_t node) { order_[nodes_[node].end++] = static_cast<std::uint32_t>(k); });
  for (std::size_t node = 1; node < nodes_.size(); ++node)
    sort_node(node);
}

std::size_t InsideTest::heights_below(double y) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(heights_, y) - heights_.begin());
}

/// The nodes that together make up the height of a side.
template <class Visit>
void InsideTest::visit_nodes(const Side& side, const Visit& visit) const {
  const auto [low, high] = std::minmax(side.a.y, side.b.y);
  std::size_t first = leaves_ + heights_below(low) - 1, end = leaves_ + heights_below(high) - 1;
  for (; first < end; first /= 2, end /= 2) {
    if (first % 2 == 1)
      visit(first++);
    if (end % 2 == 1)
      visit(--end);
  }
}

void InsideTest::sort_node(std::size_t number) {
  Node& node = nodes_[number];
  if (node.begin == node.end)
    return;
  const std::size_t height = leaves_ / std::bit_floor(number), band = (number - std::bit_floor(number)) * height;
  const double low = heights_[band], high = heights_[band + height];
  struct Crossing {
    double low, high;
    std::uint32_t side;
  };
  std::vector<Crossing> crossings;
  for (std::size_t k = node.begin; k < node.end; ++k)
    crossings.push_back({sides_[order_[k]].x_at(low), sides_[order_[k]].x_at(high), order_[k]});
  std::ranges::sort(crossings, {}, [](const Crossing& c) { return std::tuple(c.low, c.high, c.side); });
  node.is_sorted = std::ranges::is_sorted(crossings, {}, &Crossing::high);
  for (std::size_t k = 0; k < crossings.size(); ++k)
    order_[node.begin + k] = crossings[k].side;
}

bool InsideTest::contains(Point p) const {
  const std::size_t below = heights_below(p.y);
  if (below == 0 || below == heights_.size())
    return false;
  bool inside = false;
  for (std::size_t number = leaves_ + below - 1; number > 0; number /= 2) {
    const Node& node = nodes_[number];
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(node.begin);
    const auto end = order_.begin() + static_cast<std::ptrdiff_t>(node.end);
    const auto is_right = [&](std::uint32_t side) { return sides_[side].is_right_of(p); };
    const auto count = node.is_sorted ? end - std::partition_point(begin, end, std::not_fn(is_right))
                                      : std::count_if(begin, end, is_right);
    inside = inside != (count % 2 == 1);
  }
  return inside;
}

} // namespace trime_check
