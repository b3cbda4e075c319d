// SPDX-License-Identifier: BSD-3-Clause
// The checks of trime_check, in the order in which they are made. Each group of checks relies on the groups before it.
#pragma once

#include "mesh.hpp"
#include "report.hpp"
#include "stored_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime_check {

/// Cosine of the largest angle opposite to a chord, 90 degrees, with room for rounding.
constexpr double least_cosine = -1e-11;

/// One of the closed curves of the boundary of the mesh.
struct Loop {
  std::vector<std::size_t> facets; ///< numbers of its facets, in the order along the loop
  std::string kind;                ///< "outer" (around a component), "hole", or "band" (around a periodic container)
};

/// Counts from the arrays, which are compared with the numbers that the file states.
struct Counted {
  std::int64_t edges = 0, loops = 0, clockwise = 0, not_delaunay = 0, components = 0;
  std::int64_t euler_characteristic = 0, unused = 0, corners = 0;
  double area = 0;
  std::vector<Loop> boundary; ///< empty if the facets do not form closed loops without self-crossings
};

/// Checks that ids are in range and in order, that coordinates are finite, that the copies for other readers equal the
/// arrays, and the hash. Returns false if ids or coordinates are so wrong that nothing more can be checked.
bool check_arrays(const StoredFile& file, const Mesh& mesh, Report& report);

/// Checks orientation, edges, Delaunay property, loops of facets, Euler characteristic, area and tags.
Counted check_surface(const StoredFile& file, const Mesh& mesh, Report& report);

/// @brief Makes the same checks, except for tags, of a mesh that was joined along its split curves, see joined_mesh.
/// The names of the checks begin with `joined_`.
Counted check_joined_surface(const StoredFile& file, const Mesh& joined, Report& report);

/// Checks the pairs of points on curves that are split, and the boundary edges on both sides of them.
void check_splits(const StoredFile& file, const Mesh& mesh, Report& report);

/// Checks the edges on curves inside the shape, if the file has any: each is an edge of two triangles, and no vertex
/// lies in its diametral disc. @param mesh joined along its split curves
void check_curves(const StoredFile& file, const Mesh& mesh, Report& report);

/// Checks the list of all edges with labels, if the file has one.
void check_lines(const StoredFile& file, const Mesh& mesh, Report& report);

/// @brief Checks the regions of triangles and the interfaces between them, if the file has more than one region. The
/// edges between regions are listed once each, with the lower region on the left. The area inside the border of each
/// region is exactly that of its triangles. @pre the ids of the triangles are in range
void check_regions(const StoredFile& file, const Mesh& mesh, Report& report);

/// @brief Checks the table of what regions lost to each other, if the file has it. The area of a region and what it has
/// lost, less what it has gained, must be the area that it was given. @pre the ids of the triangles are in range
void check_losses(const StoredFile& file, const Mesh& mesh, Report& report);

/// @brief Checks the Voronoi cells, if the file has them: polygons, areas of cells and regions, faces, and that no
/// length of a face is negative. @pre the ids of the triangles are in range
void check_cells(const StoredFile& file, const Mesh& mesh, Report& report);

/// Checks the sizes of points and facets.
void check_sizes(const StoredFile& file, const Mesh& mesh, Report& report);

/// Checks the tables and attributes of the mesh: labels, kinds and names of loops, counts, and format version.
void check_tables(const StoredFile& file, const Mesh& mesh, const Counted& counted, Report& report);

/// A mesh with what was counted in it.
struct CountedMesh {
  const Mesh& mesh;
  const Counted& counted;
};

/// @brief Checks alpha, beta, sizes, the summary of the quality, and the stored certificate.
/// @param whole the mesh before its curves were split, which the certificate describes
void check_summary(const StoredFile& file, const CountedMesh& mesh, const CountedMesh& whole, Report& report);

/// @brief Checks corners, fixed points and boundary vertices against the shape of a config.
/// @param config path of a config file; if empty, the config that is stored in the mesh file is used
void check_shape(const StoredFile& file, const Mesh& mesh, const std::string& config, Report& report);

} // namespace trime_check
