// SPDX-License-Identifier: BSD-3-Clause
#include "formats/cell_mesh.hpp"

#include "trime/core/error.hpp"

namespace trime::formats {
namespace {

dual::Cells cells_of(const ExchangeMesh& mesh) {
  if (mesh.triangles() == 0) // all ranks find the same
    throw FileError("the mesh has no triangle; expected at least one, since there are no Voronoi cells without");
  return dual::make_cells(mesh.mesh(), mesh.names().period, mesh.comm());
}

} // namespace

CellMesh::CellMesh(const ExchangeMesh& mesh)
    : mesh_(mesh), cells_(cells_of(mesh)), vertices_(cells_, mesh.comm()),
      proof_(dual::prove(mesh.mesh(), cells_, mesh.names().regions.size(), mesh.comm())) {}

FilePlan CellMesh::proved(FilePlan plan) const {
  const dual::CellFacts& facts = proof_.facts;
  plan.checks = proof_.checks;
  plan.summary = fmt::format(
      "{} Voronoi cells with the area {:.9g}, {} of them on the boundary; shortest edge of a cell "
      "{:.3g} of the edge that it crosses; smallest area {:.6g}; at most {} corners",
      facts.cells, facts.area, facts.boundary_cells, facts.shortest_dual_edge, facts.smallest_area, facts.most_corners);
  if (facts.parts > facts.cells)
    plan.summary += fmt::format("; {} parts, since regions divide cells", facts.parts);
  return plan;
}

} // namespace trime::formats
