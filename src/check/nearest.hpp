// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest thing to a place, including images in periodic containers.
#pragma once

#include "mesh.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace trime_check {

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
