// SPDX-License-Identifier: BSD-3-Clause
// Finds which of many segments may meet a given segment, efficiently even for long slanted segments next to each other.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace trime::geometry {

/// @brief A binary tree of rotated boxes around segments of similar direction.
///
/// In a grid of square cells, n long parallel segments close to each other would share all cells. Here a group of
/// segments has a box along their mean direction. The group is divided by direction, or along or across the box,
/// whichever gives the smallest parts. Takes O(n log n) time to build and O(n) memory; immutable and thread-safe after
/// construction.
class SegmentTree {
public:
  /// @param margin a segment that is at most this far away counts as meeting
  explicit SegmentTree(std::span<const Segment> segments, double margin = 0);

  /// Calls visit(index) once for every segment that may meet `segment`, until visit returns false. All segments that do
  /// meet it are visited. Cost: O(log n + found) for segments that do not cross.
  template <class Visit>
  void for_each_near(const Segment& segment, const Visit& visit) const {
    if (!order_.empty())
      visit_node(1, {0, order_.size()}, Frame(segment), visit);
  }
  /// Visits the segments that may meet a closed box.
  template <class Visit>
  void for_each_in(const Box& box, const Visit& visit) const {
    if (!order_.empty())
      visit_node(1, {0, order_.size()}, Frame(box), visit);
  }

private:
  /// The box of a node. All points of its segments are center + u along + v across, with |u| <= half.x, |v| <= half.y.
  struct Turned {
    Vec2 center, along{1, 0}, half;
  };
  /// The target of a search: a segment, which is a rotated box without width, or an axis-parallel box.
  struct Frame : Turned {
    explicit Frame(const Segment& segment);
    explicit Frame(const Box& box);
  };
  struct Range {
    std::size_t low, high;
    std::size_t middle() const { return low + (high - low) / 2; }
  };
  void build(std::size_t node, Range range);
  Vec2 mean_direction(Range range) const;
  bool may_meet(const Turned& a, const Turned& b) const;
  template <class Visit>
  bool visit_node(std::size_t node, Range range, const Frame& frame, const Visit& visit) const {
    if (!may_meet(nodes_[node], frame))
      return true;
    if (range.high - range.low > run_length)
      return visit_node(2 * node, {range.low, range.middle()}, frame, visit) &&
             visit_node(2 * node + 1, {range.middle(), range.high}, frame, visit);
    for (std::size_t k = range.low; k < range.high; ++k)
      if (!visit(order_[k]))
        return false;
    return true;
  }

  static constexpr std::size_t run_length = 2;
  std::span<const Segment> segments_; // used only while the tree is built
  std::vector<LocalIndex> order_;
  std::vector<Turned> nodes_; // in the order of a heap: the root is 1, the children of k are 2k and 2k+1
  double slack_;              // the margin plus an allowance for rounding
};

} // namespace trime::geometry
