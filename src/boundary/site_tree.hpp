// SPDX-License-Identifier: BSD-3-Clause
// A k-d tree of boundary sites, which finds out whether a diametral circle contains other sites. Sites of a curve are
// too unevenly spread for a grid of bins.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace trime::boundary {

/// A k-d tree of sites. Immutable. Takes O(n log n) time to build, by all threads.
class SiteTree {
public:
  struct Entry {
    geometry::Vec2 position;
    LocalIndex index;
  };
  explicit SiteTree(std::vector<Entry> items);

  /// Returns a site that lies strictly inside the diametral circle of a-b, or at the place of a or b; the sites
  /// `index_a` at a and `index_b` at b do not count. Returns -1 if there is no such site. Exact.
  LocalIndex find_in_disc(geometry::Vec2 a, geometry::Vec2 b, LocalIndex index_a, LocalIndex index_b) const;
  /// Calls visit(item) for all items whose distance from `center` is less than `radius`, in the order of the tree.
  template <class Visit>
  void for_each_within(geometry::Vec2 center, double radius, const Visit& visit) const {
    visit_within(center, radius, 0, items_.size(), visit);
  }
  /// Calls visit(item) for items whose distance from `center` is less than `radius`, near ones first as far as the tree
  /// allows. visit returns the radius for the items that follow.
  template <class Visit>
  void for_each_nearer(geometry::Vec2 center, double radius, const Visit& visit) const {
    visit_nearer(center, radius, 0, items_.size(), visit);
  }
  std::size_t size() const { return items_.size(); }
  const std::vector<Entry>& items() const { return items_; }

private:
  struct Range {
    std::size_t low, high;
  };
  std::size_t split(Range range);
  void build(Range range);
  template <class Visit>
  void visit_within(geometry::Vec2 center, double radius, std::size_t low, std::size_t high, const Visit& visit) const {
    if (high - low <= leaf_size) {
      for (std::size_t k = low; k < high; ++k)
        if (geometry::squared_length(items_[k].position - center) < radius * radius)
          visit(items_[k]);
      return;
    }
    const std::size_t middle = low + (high - low) / 2;
    const Entry& item = items_[middle];
    const double offset = split_y_[middle] ? center.y - item.position.y : center.x - item.position.x;
    if (offset <= radius)
      visit_within(center, radius, low, middle, visit);
    if (geometry::squared_length(item.position - center) < radius * radius)
      visit(item);
    if (offset >= -radius)
      visit_within(center, radius, middle + 1, high, visit);
  }
  template <class Visit>
  void visit_nearer(geometry::Vec2 center, double& radius, std::size_t low, std::size_t high,
                    const Visit& visit) const {
    if (high - low <= leaf_size) {
      for (std::size_t k = low; k < high; ++k)
        if (geometry::squared_length(items_[k].position - center) < radius * radius)
          radius = visit(items_[k]);
      return;
    }
    const std::size_t middle = low + (high - low) / 2;
    const Entry& item = items_[middle];
    const double offset = split_y_[middle] ? center.y - item.position.y : center.x - item.position.x;
    const bool is_low = offset <= 0;
    visit_nearer(center, radius, is_low ? low : middle + 1, is_low ? middle : high, visit);
    if (geometry::squared_length(item.position - center) < radius * radius)
      radius = visit(item);
    if (std::fabs(offset) <= radius)
      visit_nearer(center, radius, is_low ? middle + 1 : low, is_low ? high : middle, visit);
  }

  static constexpr std::size_t leaf_size = 8;
  std::vector<Entry> items_;          // the item in the middle of a range splits the range
  std::vector<std::uint8_t> split_y_; // by item: whether it splits its range by y
};

} // namespace trime::boundary
