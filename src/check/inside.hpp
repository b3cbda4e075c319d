// SPDX-License-Identifier: BSD-3-Clause
// Finds which points lie inside rings of straight sides.
#pragma once

#include "config_text.hpp"
#include "mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace trime_check {

/// @brief Tests whether points lie inside rings, by the even-odd rule. It uses a segment tree over y: a node holds the
/// sides that cross its whole range of heights, from left to right. So a query makes a binary search in each node whose
/// range contains its height. If sides of a node cross each other, or touch within rounding, the query examines all
/// sides of that node. Cost: O(n log n) to build for n sides, O(log^2 n) for a query.
class InsideTest {
public:
  explicit InsideTest(const std::vector<Ring>& rings);

  bool contains(Point p) const;

private:
  struct Side {
    Point a, b;
    /// Returns the x coordinate at a height between those of the two ends; exact at the ends.
    double x_at(double y) const;
    /// Returns whether the side lies to the right of p. @pre the height of p is between those of the ends
    bool is_right_of(Point p) const;
  };
  struct Node {
    std::size_t begin = 0, end = 0; // range of the node in order_
    bool is_sorted = true;
  };

  template <class Visit>
  void visit_nodes(const Side& side, const Visit& visit) const;
  void sort_node(std::size_t number);
  std::size_t heights_below(double y) const;

  std::vector<double> heights_; // heights of the vertices; each height appears once
  std::size_t leaves_ =
      1; // number of leaves of the tree, which are the ranges between consecutive heights; rounded up to a power of two
  std::vector<Side> sides_;
  std::vector<Node> nodes_; // the root is node 1; nodes 2 k and 2 k + 1 are the lower and the upper half of node k
  std::vector<std::uint32_t> order_;
};

/// Returns p and its periodic images one period away; p comes first.
std::vector<Point> images_of(Point p, const Periods& periods);

/// The nearest object and its distance, which is infinite if there is no object.
struct Nearest {
  std::size_t number = 0;
  double distance = 0;
};

/// @brief Finds the nearest of many points. Cost: O(n log n) to build for n points, O(log n) per query.
class PointFinder {
public:
  PointFinder(const std::vector<Point>& points, const Periods& periods);
  ~PointFinder();
  Nearest nearest(Point p) const;
  /// Returns the nearest point except the one with this number.
  Nearest nearest_other(std::size_t number) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  Periods periods_;
};

/// Finds the nearest facet of a mesh, at the same cost as PointFinder.
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
