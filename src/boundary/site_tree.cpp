// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/site_tree.hpp"

#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <array>

namespace trime::boundary {

using geometry::Vec2;

namespace {
constexpr int serial_levels = 5;            // levels of the tree that are built one after the other, for all threads
constexpr std::size_t worth_threads = 2048; // items
} // namespace

SiteTree::SiteTree(std::vector<Entry> items) : items_(std::move(items)), split_y_(items_.size(), 0) {
  std::vector<Range> parts{{0, items_.size()}};
  for (int level = 0; level < serial_levels && items_.size() > worth_threads; ++level) {
    std::vector<Range> next(2 * parts.size(), Range{0, 0});
    thread_loop(std::ssize(parts), 1, [&](std::ptrdiff_t item, int) {
      const auto k = static_cast<std::size_t>(item);
      const std::size_t middle = split(parts[k]);
      next[2 * k] = {parts[k].low, middle};
      next[2 * k + 1] = {middle + 1, parts[k].high};
    });
    parts = std::move(next);
  }
  thread_loop(std::ssize(parts), 1, [&](std::ptrdiff_t k, int) { build(parts[static_cast<std::size_t>(k)]); });
}

void SiteTree::build(Range range) {
  while (range.high - range.low > leaf_size) {
    const std::size_t middle = split(range);
    build({range.low, middle});
    range.low = middle + 1;
  }
}

/// Puts the item in its place that splits a range; returns that place.
std::size_t SiteTree::split(Range range) {
  const auto [low, high] = range;
  geometry::Box box;
  for (std::size_t k = low; k < high; ++k)
    box.include(items_[k].position);
  const std::size_t middle = low + (high - low) / 2;
  const bool by_y = box.height() > box.width();
  const auto less = [by_y](const Entry& a, const Entry& b) {
    const double u = by_y ? a.position.y : a.position.x, v = by_y ? b.position.y : b.position.x;
    return u < v || (u == v && a.index < b.index);
  };
  std::nth_element(items_.begin() + low, items_.begin() + middle, items_.begin() + high, less);
  split_y_[middle] = by_y;
  return middle;
}

LocalIndex SiteTree::find_in_disc(Vec2 a, Vec2 b, LocalIndex index_a, LocalIndex index_b) const {
  const Vec2 center = 0.5 * (a + b);
  const double radius = 0.5 * geometry::length(b - a) * (1 + 1e-9) +
                        1e-15 * (std::fabs(center.x) + std::fabs(center.y)); // rounding must not hide a site
  const auto in_disc = [&](const Entry& item) {
    return !(item.index == index_a && item.position == a) && !(item.index == index_b && item.position == b) &&
           (geometry::diametral_side(a, b, item.position) <= 0 || item.position == a || item.position == b);
  };
  std::array<Range, 64> stack; // each level leaves at most one range waiting
  int top = 0;
  stack[top++] = {0, items_.size()};
  while (top > 0) {
    const Range range = stack[--top];
    if (range.high - range.low <= leaf_size) {
      for (std::size_t k = range.low; k < range.high; ++k)
        if (in_disc(items_[k]))
          return items_[k].index;
      continue;
    }
    const std::size_t middle = range.low + (range.high - range.low) / 2;
    const Entry& item = items_[middle];
    if (in_disc(item))
      return item.index;
    const double offset = split_y_[middle] ? center.y - item.position.y : center.x - item.position.x;
    if (offset <= radius)
      stack[top++] = {range.low, middle};
    if (offset >= -radius)
      stack[top++] = {middle + 1, range.high};
  }
  return -1;
}

} // namespace trime::boundary
