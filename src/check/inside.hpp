// SPDX-License-Identifier: BSD-3-Clause
// Finds which points lie inside of rings of straight sides, and the nearest thing to a place, including images in
// periodic containers.
#pragma once

#include "config_text.hpp"
#include "mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
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

/// p and its images one period away, p first.
std::vector<Point> images_of(Point p, const Periods& periods);

/// The nearest one; `distance` is infinite if there is no candidate.
struct Nearest {
  std::size_t number = 0;
  double distance = 0;
};

/// @brief Finds points. n log n to build, log n for a question.
class PointFinder {
public:
  PointFinder(const std::vector<Point>& points, const Periods& periods);
  ~PointFinder();
  Nearest nearest(Point p) const;
  /// Returns the nearest one except the point with this number.
  Nearest nearest_other(std::size_t number) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  Periods periods_;
};

/// Finds facets of a mesh, at the cost of `PointFinder`.
class FacetFinder {
public:
  explicit FacetFinder(const Mesh& mesh);
  ~FacetFinder();
  Nearest nearest(Point p) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  Periods periods_;
};

} // namespace trime_check
