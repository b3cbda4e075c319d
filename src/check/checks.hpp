// SPDX-License-Identifier: BSD-3-Clause
// The checks, in the order in which they are made. Each file of checks needs what those before it have passed.
#pragma once

#include "mesh.hpp"
#include "report.hpp"
#include "stored_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime_check {

/// One of the closed curves of the boundary.
struct Loop {
  std::vector<std::size_t> facets; ///< in the order in which they follow each other
  std::string kind;                ///< around a component (outer), around a hole, or a band around a periodic container
};

/// Counts to compare with the numbers in the file.
struct Counted {
  std::int64_t edges = 0, loops = 0, clockwise = 0, not_delaunay = 0, components = 0;
  std::int64_t euler_characteristic = 0, unused = 0, corners = 0;
  double area = 0;
  std::vector<Loop> boundary; ///< empty if the facets are no closed simple loops
};

/// Ids in range and in order, coordinates finite, views equal to the arrays, the hash. False: ids or coordinates are
/// such that nothing more can be said.
bool check_arrays(const StoredFile& file, const Mesh& mesh, Report& report);

/// Orientation, edges, Delaunay, loops of facets, Euler characteristic, area, tags.
Counted check_surface(const StoredFile& file, const Mesh& mesh, Report& report);

/// Sizes of points and facets.
void check_sizes(const StoredFile& file, const Mesh& mesh, Report& report);

/// Checks the tables and attributes of the mesh: labels, kinds and names of loops, counts, format.
void check_tables(const StoredFile& file, const Mesh& mesh, const Counted& counted, Report& report);

/// Alpha, beta, sizes, the quality summary, and the certificate as it is stored.
void check_summary(const StoredFile& file, const Mesh& mesh, const Counted& counted, Report& report);

/// @brief Corners, fixed points and boundary vertices against the shape of a config.
/// @param config path of a config file; empty: the text that is stored in the mesh file
void check_shape(const StoredFile& file, const Mesh& mesh, const std::string& config, Report& report);

} // namespace trime_check
