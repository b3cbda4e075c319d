// SPDX-License-Identifier: BSD-3-Clause
// How many points a mesh of a given edge length has.
#pragma once

#include "core/angle.hpp"
#include "trime/geometry/boundary.hpp"

#include <algorithm>

namespace trime::fitting {

/// About how many points fill the shape with equilateral triangles of one edge length; at least those of one triangle.
inline double points_of_length(const geometry::Boundary& boundary, double h) {
  return std::max(3.0, boundary.area / (row_height * h * h) + 0.5 * boundary.length() / h);
}

} // namespace trime::fitting
