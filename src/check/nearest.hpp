// SPDX-License-Identifier: BSD-3-Clause
// What lies nearest to a place, images of periodic containers too.
#pragma once

#include "mesh.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace trime_check {

/// p and its images one period away, p first.
std::vector<Point> images_of(Point p, const Periods& periods);

/// The one that is nearest; `distance` is infinite if there is none.
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
  /// The nearest one but for the point of this number.
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
