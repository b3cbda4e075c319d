// SPDX-License-Identifier: BSD-3-Clause
// Gives the Voronoi cells of a mesh to a finite-volume solver on the same ranks, in memory: polygons, areas, the faces
// between neighbours and on the boundary. The triangles of a mesh have empty diametral circles on the boundary and
// between regions, so no cell needs clipping, and no length of a face is negative. No file is written.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/handover/local_mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace trime::dual {

/// @brief The Voronoi cells of the points of one rank's part of a mesh. Cell i is the cell of local point i of the
/// handover::LocalMesh from which it was made, its site; a rank has the cells of its owned points, and knows areas and
/// centroids of the cells of its ghosts. All point, triangle and facet numbers are those of the LocalMesh. Lengths are
/// in the unit of the container, areas in its square.
///
/// The cell of a point inside consists of the circumcentres of the triangles around it, counter-clockwise. That of a
/// point on the boundary begins with the middle of one boundary edge, then come the circumcentres, the middle of the
/// other boundary edge, and the site. Where regions meet, they divide a cell into parts along the edges of the mesh.
/// In a periodic container a cell lies around its site, so it may reach across the border of the container.
struct LocalCells {
  LocalIndex cells = 0;       ///< number of cells: the owned points of the LocalMesh
  LocalIndex owned_faces = 0; ///< number of faces that this rank owns; those of other ranks follow them

  // Arrays with one entry for each local point.
  std::vector<double> areas;             ///< [owned + ghosts], area of the cell
  std::vector<geometry::Vec2> centroids; ///< [owned + ghosts], centre of mass of the cell

  /// Places of the corners of the polygons. Entry t, for each local triangle t, is its circumcentre; the others are
  /// middles of edges, sites, and, in a periodic container, images of those.
  std::vector<geometry::Vec2> vertices;

  // Polygons of cells: cell i has the corners corner_first[i] ... corner_first[i + 1] - 1, counter-clockwise.
  std::vector<std::int64_t> corner_first; ///< [cells + 1]
  std::vector<LocalIndex> corners;        ///< indices into vertices

  // Parts of cells. Cell i has the parts part_first[i] ... part_first[i + 1] - 1: a single one, unless regions meet.
  std::vector<std::int64_t> part_first;        ///< [cells + 1]
  std::vector<std::int32_t> part_regions;      ///< [parts], region of the part, from 1
  std::vector<double> part_areas;              ///< [parts]
  std::vector<geometry::Vec2> part_centroids;  ///< [parts]
  std::vector<std::int64_t> part_corner_first; ///< [parts + 1]
  std::vector<LocalIndex> part_corners;        ///< indices into vertices, counter-clockwise

  // Arrays with one entry for each face between a cell of this rank and another cell: there is one for each edge of the
  // mesh that ends at an owned point, also for edges on the boundary. A rank owns the face if it owns its first cell.
  std::vector<std::array<LocalIndex, 2>> faces; ///< the two cells (local points), the lower global id first
  std::vector<geometry::Vec2> face_arms; ///< vector from the site of the first cell to that of the second: normal to
                                         ///< the face; its length is the primal length
  /// Length of the face (dual length) in each of at most two regions: half of the edge times the cotangent of the
  /// opposite angle, for one triangle or both. Never negative except by rounding. The second one is 0 if the face lies
  /// in one region.
  std::vector<std::array<double, 2>> face_lengths;
  std::vector<std::array<std::int32_t, 2>> face_regions; ///< regions of these lengths, from 1; 0: there is no second
  /// The ends of the face, as indices into vertices: on the right and on the left of the arm. At the boundary one end
  /// is the middle of the edge.
  std::vector<std::array<LocalIndex, 2>> face_vertices;

  // The neighbours of cell i are neighbour_first[i] ... neighbour_first[i + 1] - 1, counter-clockwise.
  std::vector<std::int64_t> neighbour_first; ///< [cells + 1]
  std::vector<LocalIndex> neighbours;        ///< local points
  std::vector<LocalIndex> neighbour_faces;   ///< the face that the cell shares with the neighbour

  // Arrays with one entry for each chord: the part of a cell's rim on the boundary of the mesh, which is half of a
  // boundary edge. Each cell on the boundary has two of them, one after the other.
  std::vector<LocalIndex> chord_cells;
  std::vector<LocalIndex> chord_facets;      ///< local facet of the chord, which has its name, tag and triangle
  std::vector<geometry::Vec2> chord_normals; ///< outward, with the length of the chord
};

/// @brief Makes the cells of the owned points. They have the same bits on any number of ranks.
/// @param mesh with Overlap::triangles
/// @param period of the container; 0 in a direction in which it is not periodic
/// @throws FileError on all ranks if the triangles around a point are not one fan, or if
/// a boundary edge is missing, as with Overlap::none
/// @note Collective: one exchange with the neighbouring ranks for areas and centroids of ghosts. Takes O(n) time for n
/// points on this rank. Memory: 380 bytes per point; while they are made, 130 more.
LocalCells make_local_cells(const comm::Communicator& comm, const handover::LocalMesh& mesh, geometry::Vec2 period);

} // namespace trime::dual
