// SPDX-License-Identifier: BSD-3-Clause
// Which points lie inside of rings of straight sides.
#pragma once

#include "config_text.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime_check {

/// @brief Insides of rings by even-odd. A segment tree over y: in a node lie sides that run through its whole height,
/// from left to right. So a question is a binary search in each node above its height. Where sides of a node cross, or
/// touch but for rounding, all of them are asked. n log n to build, log^2 n for a question.
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
