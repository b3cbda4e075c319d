// SPDX-License-Identifier: BSD-3-Clause
// Which segments may meet another one, also among long slanted ones that lie side by side.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace trime::geometry {

/// @brief Turned boxes around segments of like direction, in a binary hierarchy.
///
/// In square cells n parallel segments, thin against their length, are all in each other's company. A group of them
/// here has a box along their mean direction, and is divided by direction, across or along it, whatever makes its parts
/// smaller. O(n log n) to build, O(n) memory; immutable and thread-safe after.
class SegmentTree {
public:
  /// @param margin how near a segment counts as one that is met
  explicit SegmentTree(std::span<const Segment> segments, double margin = 0);

  /// Calls visit(index) for every segment that may meet `segment`, each once, until it returns false; never misses one
  /// that does meet it. For segments that do not cross O(log n + found).
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
  /// The box of a node: all its segments lie in center + u along + v across, |u| <= half.x, |v| <= half.y.
  struct Turned {
    Vec2 center, along{1, 0}, half;
  };
  /// The target of a search: a segment, as a box without width, or a box that is not turned.
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
  std::span<const Segment> segments_; // while it is built
  std::vector<LocalIndex> order_;
  std::vector<Turned> nodes_; // heap order: the root is 1, the children of k are 2k and 2k+1
  double slack_;              // the margin, and for rounding
};

} // namespace trime::geometry
