// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cells of the points of a mesh, distributed over the ranks. Each rank gets an equally long range of points
// (its sites) with all triangles around them. A mesh whose boundary edges have empty diametral circles has cells that
// need no clipping: the circumcentres of the triangles around a site, and on the boundary the middles of its two
// boundary edges and the site itself. See Si, Gaertner and Fuhrmann, Comput. Math. Math. Phys. 50 (2010).
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace trime::dual {

/// Equally long ranges of numbers for all ranks, so that no rank needs a list of ranges.
struct Shares {
  GlobalId total = 0;
  int ranks = 1;

  GlobalId first(int rank) const { return total * rank / ranks; }
  int rank_of(GlobalId number) const { return static_cast<int>(((number + 1) * ranks - 1) / total); }
};

/// Returns the vector from one point to another, the shortest one if there are periods (0: not periodic).
inline geometry::Vec2 difference(geometry::Vec2 to, geometry::Vec2 from, geometry::Vec2 period) {
  geometry::Vec2 d = to - from;
  if (period.x > 0)
    d.x -= period.x * std::nearbyint(d.x / period.x);
  if (period.y > 0)
    d.y -= period.y * std::nearbyint(d.y / period.y);
  return d;
}

/// @brief Returns the circumcentre of the triangle (0, b, c), which is counter-clockwise, relative to its first corner.
/// All ranks compute it from the corner with the lowest number, so that it has the same bits everywhere.
inline geometry::Vec2 circumcentre(geometry::Vec2 b, geometry::Vec2 c) {
  const double bb = squared_length(b), cc = squared_length(c), twice = 2 * cross(b, c);
  return {(bb * c.y - cc * b.y) / twice, (cc * b.x - bb * c.x) / twice};
}

/// A triangle at a site of this rank.
struct CellTriangle {
  GlobalId number;
  std::array<LocalIndex, 3> corners; ///< the one with the lowest number first; see Cells::points
  std::int32_t region;

  /// Returns the corner that follows a site `steps` places later, counter-clockwise. @pre the site is a corner
  LocalIndex corner_behind(LocalIndex site, std::size_t steps) const {
    return corners[((corners[0] == site ? 0 : corners[1] == site ? 1 : 2) + steps) % 3];
  }
};

/// The triangles around a site, counter-clockwise: from the lowest number if they close, else from the edge behind
/// which the mesh ends.
struct Fan {
  std::span<const LocalIndex> triangles; ///< indices into Cells::triangles
  bool is_closed;
};

/// @brief The cells of one rank. Memory: 96 bytes per point.
struct Cells {
  Shares shares;               ///< shares of the sites
  GlobalId first_site = 0;     ///< number of the first site of this rank
  LocalIndex site_count = 0;   ///< on this rank
  GlobalId triangle_count = 0; ///< over all ranks
  geometry::Vec2 period{0, 0};
  std::vector<geometry::Vec2> points;  ///< the sites, then points of other ranks
  std::vector<GlobalId> foreign;       ///< numbers of the points of other ranks, ascending
  std::vector<CellTriangle> triangles; ///< triangles with a corner at a site of this rank, by number
  std::vector<std::int64_t> fan_first; ///< for each site, and the end: its first entry in `fans`
  std::vector<LocalIndex> fans;        ///< indices of triangles, site by site
  std::vector<bool> closed;            ///< for each site: no boundary edge ends there
  std::vector<bool> divided;           ///< for each site: the boundary or an interface divides its cell
  /// Places of the points mesh.foreign, for those who write the triangles of this rank's slab.
  std::vector<geometry::Vec2> slab_places;

  GlobalId number_of(LocalIndex point) const {
    return point < site_count ? first_site + point : foreign[at(point - site_count)];
  }
  bool is_here(GlobalId site) const { return site >= first_site && site < first_site + site_count; }
  Fan fan(LocalIndex site) const {
    const auto from = fan_first[at(site)], to = fan_first[at(site) + 1];
    return {std::span(fans).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from)),
            closed[at(site)]};
  }
  /// Returns the region of a cell that lies inside of one region; 0 if the boundary or an interface divides the cell.
  std::int32_t region_inside(LocalIndex site) const {
    return divided[at(site)] ? 0 : triangles[at(fans[static_cast<std::size_t>(fan_first[at(site)])])].region;
  }
  /// Returns the circumcentre of a triangle relative to a place next to it.
  geometry::Vec2 centre_from(geometry::Vec2 place, const CellTriangle& triangle) const {
    return difference(points[at(triangle.corners[0])], place, period) + centre_of(triangle);
  }
  /// Returns the circumcentre of a triangle relative to its first corner.
  geometry::Vec2 centre_of(const CellTriangle& triangle) const {
    const geometry::Vec2 first = points[at(triangle.corners[0])];
    return circumcentre(difference(points[at(triangle.corners[1])], first, period),
                        difference(points[at(triangle.corners[2])], first, period));
  }
};

/// @brief Finds the triangles around each point, and their circumcentres.
/// @param period of the container; 0 in a direction in which it is not periodic
/// @throws FileError on all ranks if the triangles around a point are not one fan
/// @note Collective; sparse exchanges. The cells do not depend on the number of ranks.
Cells make_cells(const mesh::DistributedMesh& mesh, geometry::Vec2 period, const comm::Communicator& comm);

/// @brief Finds the triangles around each site: sets fan_first, fans, closed and divided.
/// @throws FileError on all ranks if the triangles around a site are not one fan
/// @pre points, site_count and triangles are set; all triangles at a site are there
/// @note Collective.
void find_fans(Cells& cells, const comm::Communicator& comm);

/// A triangle of this rank's slab of the mesh: its first corner, and the vectors from there to the others.
struct SlabTriangle {
  geometry::Vec2 first, b, c;
};
SlabTriangle slab_triangle(const mesh::DistributedMesh& mesh, const Cells& cells, std::size_t triangle);

/// Returns the circumcentre of a triangle of this rank's slab of the mesh.
geometry::Vec2 slab_centre(const mesh::DistributedMesh& mesh, const Cells& cells, std::size_t triangle);

} // namespace trime::dual
