// SPDX-License-Identifier: BSD-3-Clause
// Finds which points lie inside rings of straight sides.
#pragma once

#include "config_text.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime_check {

/// @brief Tests points against rings by the even-odd rule, with a segment tree over y. A node holds the sides that
/// cross its whole height, from left to right. So a query is a binary search in each node that contains its height.
/// Where sides of a node cross, or touch within rounding, the query examines all of them. O(n log n) to build, O(log^2
/// n) for a query.
class InsideTest {
public:
  explicit InsideTest(const std::vector<Ring>& rings);

  bool contains(Point p) const;

private:
  struct Side {
    Point a, b;
    /// Returns x at a height between those of the ends; exact at the ends.
    double x_at(double y) const;
    /// Returns whether the side lies to the right of p. @pre the height of p is between those of the ends
    bool is_right_of(Point p) const;
  };
  struct Node {
    std::size_t begin = 0, end = 0; // range of order_
    bool is_sorted = true;
  };

  template <class Visit>
  void visit_nodes(const Side& side, const Visit& visit) const;
  void sort_node(std::size_t number);
  std::size_t heights_below(double y) const;

  std::vector<double> heights_; // heights of vertices, each once
  std::size_t leaves_ = 1;      // leaves of the tree, which are the bands between heights; a power of two
  std::vector<Side> sides_;
  std::vector<Node> nodes_; // the root is 1; 2 k and 2 k + 1 are the lower and the upper half of k
  std::vector<std::uint32_t> order_;
};

} // namespace trime_check
