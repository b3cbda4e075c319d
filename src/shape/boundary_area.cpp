// SPDX-License-Identifier: BSD-3-Clause
#include "shape/boundary_area.hpp"

#include "core/angle.hpp"
#include "shape/vertex_table.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::shape {

using geometry::Boundary;
using geometry::Frame;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

double twice_area_under(const std::vector<Piece>& pieces, Vec2 origin) {
  double sum = 0;
  for (const Piece& piece : pieces) {
    double area = cross(piece.start - origin, piece.end - origin);
    if (piece.circular)
      area += piece.radius * piece.radius * (piece.sweep - sin_cos(piece.sweep).sin);
    sum += area;
  }
  return sum;
}

bool is_sliver(const Loop& loop, double twice_area, const Frame& frame) {
  return !loop.winds() && std::fabs(twice_area) <= VertexTable::merge_steps * frame.step() * loop.length();
}

void settle_area_on_torus(Boundary& boundary, double torus) {
  const bool winds =
      std::any_of(boundary.loops.begin(), boundary.loops.end(), [](const Loop& loop) { return loop.winds(); });
  boundary.covers_torus = !winds && boundary.area < 0;
  boundary.area -= torus * std::floor(boundary.area / torus);
}

double least_area(const Boundary& boundary, const Frame& frame) {
  return 0.5 * VertexTable::merge_steps * frame.step() * boundary.length();
}

void check_area(const Boundary& boundary, const std::string& region, const Frame& frame) {
  if (const double least = least_area(boundary, frame); !(boundary.area > least)) {
    const Vec2 p = boundary.loops.front().pieces.front().start;
    throw GeometryError(
        fmt::format("the geometry '{}' is thinner than the resolution of the container: expected an area above {:.3g} "
                    "inside of a boundary of length {:.6g}, found {:.3g}; its boundary begins at {}",
                    region, least, boundary.length(), boundary.area, Place(p, 10)));
  }
}

} // namespace trime::shape
