// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest point or facet to a place, including images in periodic containers.
#pragma once

#include "mesh.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace trime_check {

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
