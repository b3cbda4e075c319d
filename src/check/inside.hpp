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

/// Returns p and its images one period away, p first.
std::vector<Point> images_of(Point p, const Periods& periods);

/// The nearest object; `distance` is infinite if there is no candidate.
struct Nearest {
  std::size_t number = 0;
  double distance = 0;
};

/// @brief Finds points. O(n log n) to build, O(log n) per query.
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

/// Finds facets of a mesh, at the same cost as PointFinder.
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
