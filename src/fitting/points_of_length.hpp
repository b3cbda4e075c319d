// SPDX-License-Identifier: BSD-3-Clause
// Estimates the number of points for an edge length, or the reverse, from the area and the perimeter of a shape.
#pragma once

#include "core/angle.hpp"
#include "trime/geometry/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace trime::fitting {

/// Returns about how many points fill the shape with equilateral triangles of one edge length; at least those of one
/// triangle.
inline double points_of_length(const geometry::Boundary& boundary, double h) {
  return std::max(3.0, boundary.area / (row_height * h * h) + 0.5 * boundary.length() / h);
}

/// Returns the edge length of almost equilateral triangles with n vertices, on area A inside perimeter P: from V = (T +
/// B)/2 + 1 with T = A / (sqrt(3)/4 h^2) and B = P/h.
inline double estimated_size(double area, double perimeter, double n) {
  const double a = 2 * area / std::sqrt(3.0), b = perimeter / 2;
  return (b + std::sqrt(b * b + 4 * a * n)) / (2 * n);
}

} // namespace trime::fitting
