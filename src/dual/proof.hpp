// SPDX-License-Identifier: BSD-3-Clause
// Proves that Voronoi cells cover the mesh once and that no length between two cells is negative, from the cells as
// they are written. Finite volumes on such cells have no negative coefficient.
#pragma once

#include "dual/vertices.hpp"
#include "trime/mesh/quality.hpp"

namespace trime::dual {

/// Holds counts and extremes of the cells of all ranks.
struct CellFacts {
  GlobalId cells = 0, boundary_cells = 0;
  GlobalId parts = 0;            ///< cells are divided where regions meet
  std::int64_t most_corners = 0; ///< largest number of corners of a cell
  double area = 0;
  double smallest_area = 0;      ///< smallest area of a cell
  double shortest_dual_edge = 0; ///< least length of a face inside the mesh over that of its edge
};

struct CellProof {
  CellFacts facts;
  mesh::Checks checks;
};

/// @brief Compares the areas of the cells with those of the triangles, also for each region, to 1e-12. It looks for
/// circumcentres outside of their region and for negative lengths between cells, which may only be roundings of the
/// coordinates; compares the Euler numbers of cells and triangles. The result does not depend on the number of ranks.
/// @param regions number of regions
/// @note Collective.
CellProof prove(const mesh::DistributedMesh& mesh, const Cells& cells, std::size_t regions,
                const comm::Communicator& comm);

} // namespace trime::dual
