// SPDX-License-Identifier: BSD-3-Clause
// Shapes in periodic containers for the tests, and a torus that a hexagonal lattice fits exactly.
#pragma once

#include "trime/shape/region_shape.hpp"

#include <cmath>
#include <vector>

namespace trime::testing {

inline const geometry::Frame& unit_torus() {
  static const geometry::Frame frame(geometry::Box{{0, 0}, {1, 1}}, true, true);
  return frame;
}
/// Returns the unit square with periods along x only.
inline const geometry::Frame& unit_cylinder() {
  static const geometry::Frame frame(geometry::Box{{0, 0}, {1, 1}}, true, false);
  return frame;
}

inline shape::RegionShape whole_torus() {
  return {{}, "domain", unit_torus()};
}
/// Returns the torus minus a disc around the common corner of the container.
inline shape::RegionShape torus_with_hole(double radius = 0.2) {
  return {{shape::Part::circle("hole", {0, 0}, radius, unit_torus())}, "difference(domain, hole)", unit_torus()};
}
/// Returns a disc around the common corner of the container, which is one disc on the torus.
inline shape::RegionShape disc_at_corner() {
  return {{shape::Part::circle("disc", {1, 1}, 0.3, unit_torus())}, "disc", unit_torus()};
}
/// Returns a band around the cylinder, between y = 0.25 and y = 0.75.
inline shape::RegionShape band() {
  return {{shape::Part::rectangle("band", {{0, 0.25}, {1, 0.75}}, unit_cylinder())}, "band", unit_cylinder()};
}
/// Returns a band around the cylinder with half a disc added on its upper side and half a disc cut out of its lower
/// side.
inline shape::RegionShape wavy_band() {
  return {{shape::Part::rectangle("band", {{0, 0.25}, {1, 0.75}}, unit_cylinder()),
           shape::Part::circle("bump", {0.98, 0.75}, 0.1, unit_cylinder()),
           shape::Part::circle("dent", {0.03, 0.25}, 0.15, unit_cylinder())},
          "difference(union(band, bump), dent)",
          unit_cylinder()};
}
/// Returns a band that winds around the torus in both directions, without a tilted triangle across the border.
inline shape::RegionShape slanted_band() {
  const contours::Contour contour = contours::make_contour(
      {{{-0.25, -0.25}, {0.25, -0.25}, {1.25, 0.75}, {1.25, 1.25}, {0.75, 1.25}, {-0.25, 0.25}}}, "slanted");
  return {{shape::Part::contour("slanted", contour, {}, unit_torus()),
           shape::Part::triangle("cut", {{{-0.05, 0.47}, {0.12, 0.5}, {0.02, 0.62}}}, unit_torus())},
          "difference(slanted, cut)",
          unit_torus()};
}

inline std::vector<shape::RegionShape> periodic_shapes() {
  return {whole_torus(), torus_with_hole(), disc_at_corner(), band(), wavy_band(), slanted_band()};
}

/// Calls visit(shift) for the point itself and for its periodic images up to two periods away.
template <class Visit>
void for_each_image(const geometry::Periods& periods, const Visit& visit) {
  visit(geometry::Vec2{});
  for (int i = periods.x > 0 ? -2 : 0; i <= (periods.x > 0 ? 2 : 0); ++i)
    for (int j = periods.y > 0 ? -2 : 0; j <= (periods.y > 0 ? 2 : 0); ++j)
      if (i != 0 || j != 0)
        visit(geometry::Vec2{i * periods.x, j * periods.y});
}

/// @brief Returns a container that a hexagonal lattice of `columns` x `rows` sites with spacing 1/columns fits exactly;
/// rows are parallel to x.
/// @pre rows is even
inline geometry::Box hexagonal_container(int columns, int rows) {
  return {{0, 0}, {1, std::sqrt(0.75) * rows / columns}};
}

} // namespace trime::testing
