// SPDX-License-Identifier: BSD-3-Clause
// Finds which points lie inside of rings of straight sides.
#pragma once

#include "config_text.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime_check {

/// @brief Inside test for rings by the even-odd rule, with a segment tree over y. A node holds sides that run through
/// its whole height, from left to right. So a query is a binary search in each node above its height. Where sides of a
/// node cross, or touch within rounding, the query examines all of them. O(n log n) to build, O(log^2 n) for a query.
class InsideTest {
public:
  explicit InsideTest(const std::vector<Ring>& rings);

  bool contains(Point p) const;

private:
  struct Side {
    Point a, b;
    /// At a height between those of its ends; exact at them.
    double x_at(double y) const;
    /// Does it lie on the right of p? @pre p is at a height of the side
    bool is_right_of(Point p) const;
  };
  struct Node {
    std::size_t begin = 0, end = 0; // in order_
    bool is_sorted = true;
  };

  template <class Visit>
  void visit_nodes(const Side& side, const Visit& visit) const;
  void sort_node(std::size_t number);
  std::size_t heights_below(double y) const;

  std::vector<double> heights_; // of vertices, each once
  std::size_t leaves_ = 1;      // of the tree, a power of two: the bands between heights
  std::vector<Side> sides_;
  std::vector<Node> nodes_; // 1: the root; 2 k and 2 k + 1: the lower and the upper half of k
  std::vector<std::uint32_t> order_;
};

} // namespace trime_check
