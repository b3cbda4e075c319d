// SPDX-License-Identifier: BSD-3-Clause
// The geometry of one Voronoi cell, all of it relative to its site: the neighbours and triangles around the site, the
// parts of the cell in each region, and the lengths of its edges. Plain functions without communication.
#pragma once

#include "dual/cells.hpp"

#include <optional>
#include <vector>

namespace trime::dual {

/// @brief Holds what lies around a site, counter-clockwise. Spoke k is the edge from the site to a neighbour, and
/// triangle k lies between the spokes k and k + 1. At a site on the boundary there is one spoke more than triangles.
struct Surroundings {
  bool is_closed = true;               ///< no boundary edge ends at the site
  std::vector<LocalIndex> ends;        ///< by spoke: the neighbour, see Cells::points
  std::vector<geometry::Vec2> arms;    ///< by spoke: the vector to the neighbour
  std::vector<LocalIndex> triangles;   ///< see Cells::triangles
  std::vector<geometry::Vec2> centres; ///< by triangle: its circumcentre
  std::vector<std::int32_t> regions;   ///< by triangle

  /// Return the triangle on the left or on the right of a spoke; none outside of the mesh.
  std::optional<std::size_t> left(std::size_t spoke) const {
    return spoke < triangles.size() ? std::optional(spoke) : std::nullopt;
  }
  std::optional<std::size_t> right(std::size_t spoke) const {
    return spoke > 0 ? std::optional(spoke - 1) : is_closed ? std::optional(triangles.size() - 1) : std::nullopt;
  }
  /// Returns whether the cell is divided at the middle of this spoke: at the boundary, or between two regions.
  bool is_divided_at(std::size_t spoke) const {
    const auto on_left = left(spoke), on_right = right(spoke);
    return !on_left || !on_right || regions[*on_left] != regions[*on_right];
  }
  /// Returns whether the cell has several parts, or lies at the boundary.
  bool is_divided() const {
    for (std::size_t spoke = 0; spoke < arms.size(); ++spoke)
      if (is_divided_at(spoke))
        return true;
    return false;
  }
  /// Returns the middle of a spoke.
  geometry::Vec2 middle(std::size_t spoke) const { return 0.5 * arms[spoke]; }
  /// Returns the spoke that follows after some steps counter-clockwise.
  std::size_t spoke_behind(std::size_t first, std::size_t steps) const { return (first + steps) % arms.size(); }
};

/// Looks around a site of this rank. `around` is a buffer.
void look_around(const Cells& cells, LocalIndex site, Surroundings& around);

/// Calls use(end) for the neighbours of a site as Surroundings::ends lists them, which is faster than to look around.
template <class Use>
void for_each_end(const Cells& cells, LocalIndex site, const Use& use) {
  const Fan fan = cells.fan(site);
  for (const LocalIndex triangle : fan.triangles)
    use(cells.triangles[at(triangle)].corner_behind(site, 1));
  if (!fan.is_closed)
    use(cells.triangles[at(fan.triangles.back())].corner_behind(site, 2));
}

/// @brief A part of a cell: a run of triangles of one region. Its corners are the circumcentres of these triangles. If
/// the part is not a whole cell inside the mesh, the middle of the spoke before them comes first, and the middle of the
/// spoke behind them and the site come last.
struct CellPart {
  std::int32_t region;
  std::size_t first_spoke;
  std::size_t triangles;
  bool is_round; ///< goes all the way round the site
};

/// Returns the parts of a cell, one for each run of triangles of one region.
std::vector<CellPart> parts_of(const Surroundings& around);
/// Calls use(part) for each part of a cell; most cells have one, which needs no list.
template <class Use>
void for_each_part(const Surroundings& around, const Use& use) {
  if (!around.is_divided()) {
    use(CellPart{around.regions[0], 0, around.triangles.size(), true});
    return;
  }
  for (const CellPart& part : parts_of(around))
    use(part);
}
/// Returns the whole cell as one part, with the region of its largest share; among equal ones the lowest number.
CellPart whole_cell(const Surroundings& around);

/// Calls use.centre(triangle), use.middle(spoke) or use.site() for each corner of a part, counter-clockwise.
template <class Use>
void for_each_corner(const Surroundings& around, const CellPart& part, Use&& use) {
  if (!part.is_round)
    use.middle(part.first_spoke);
  for (std::size_t k = 0; k < part.triangles; ++k)
    use.centre((part.first_spoke + k) % around.triangles.size());
  if (!part.is_round) {
    use.middle(around.spoke_behind(part.first_spoke, part.triangles));
    use.site();
  }
}

/// Returns the corners of a part, relative to the site.
std::vector<geometry::Vec2> corners_of(const Surroundings& around, const CellPart& part);

/// The area of a polygon, positive if it is counter-clockwise, and its centroid.
struct Moments {
  double area;
  geometry::Vec2 centroid;
};
/// @pre the area is not zero
Moments moments_of(std::span<const geometry::Vec2> corners);
/// Returns those of a part, relative to the site, without a list of its corners.
Moments moments_of(const Surroundings& around, const CellPart& part);
/// Returns those of a cell that lies inside of one region, see Cells::region_inside, with the same bits.
Moments moments_inside(const Cells& cells, LocalIndex site);

/// @brief Returns the signed length of the dual edge of a spoke within one triangle next to it: from the middle of the
/// spoke to the circumcentre, positive towards the triangle. It is half of the spoke times the cotangent of the angle
/// opposite to it.
double half_dual_length(const Surroundings& around, std::size_t spoke, std::size_t triangle);

/// @brief Returns the kites of the triangle (0, b, c), which is counter-clockwise: the signed areas between each
/// corner, the middles of the two sides at the corner, and the circumcentre. The kites of a triangle add up to its
/// area, and those around a site to the area of its cell.
std::array<double, 3> kites_of(geometry::Vec2 b, geometry::Vec2 c);
/// Returns the kite at a site in each triangle around it.
std::vector<double> kites_around(const Surroundings& around);

/// An edge of the mesh as a face between two cells.
struct CellFace {
  double length = 0;                     ///< from site to site
  std::int64_t parts = 0;                ///< 1, or 2 if regions meet at the edge
  std::array<std::int32_t, 2> regions{}; ///< that of each part
  std::array<double, 2> dual_lengths{};  ///< lengths of the face in each region; inside of one region their sum
  bool is_boundary = false;

  double dual_length() const { return dual_lengths[0] + dual_lengths[1]; }
};
/// Returns the face that belongs to a spoke.
CellFace face_of(const Surroundings& around, std::size_t spoke);

} // namespace trime::dual
