// SPDX-License-Identifier: BSD-3-Clause
// Estimates the number of points for an edge length, or the reverse, from the area and the perimeter of a shape.
#pragma once

#include "core/angle.hpp"
#include "trime/geometry/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace trime::fitting {

/// Returns about how many points fill the shape with equilateral triangles of edge length h; at least 3, the points of
/// one triangle.
inline double points_of_length(const geometry::Boundary& boundary, double h) {
  return std::max(3.0, boundary.area / (row_height * h * h) + 0.5 * boundary.length() / h);
}

/// Returns the edge length of almost equilateral triangles with n vertices, from the area A and the perimeter P of the
/// region that they fill. The formula follows from V = (T + B)/2 + 1 for V vertices, where T = A / (sqrt(3)/4 h^2) is
/// the number of triangles and B = P/h that of boundary edges.
inline double estimated_size(double area, double perimeter, double n) {
  const double a = 2 * area / std::sqrt(3.0), b = perimeter / 2;
  return (b + std::sqrt(b * b + 4 * a * n)) / (2 * n);
}

/// Rounds a number of points up to a number with two digits, for messages.
inline double rounded_up(double points) {
  const double unit = std::pow(10, std::fmax(0, std::floor(std::log10(std::fmax(points, 1))) - 1));
  return std::ceil(points / unit) * unit;
}

} // namespace trime::fitting
