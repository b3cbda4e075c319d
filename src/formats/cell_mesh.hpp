// SPDX-License-Identifier: BSD-3-Clause
// Gives the Voronoi cells of a mesh to the writers of formats: as rows of sites and of vertices, in the order of their
// numbers.
#pragma once

#include "dual/proof.hpp"
#include "formats/exchange_mesh.hpp"

#include <memory>
#include <string>
#include <vector>

namespace trime::formats {

/// The cells of a mesh, their vertices, and the proof that they are right.
class CellMesh {
public:
  /// Makes the cells. @pre the mesh outlives this object
  /// @throws FileError on all ranks if a point has no cell, or if the mesh has no triangle
  /// @note Collective.
  explicit CellMesh(const ExchangeMesh& mesh);

  const ExchangeMesh& mesh() const { return mesh_; }
  const dual::Cells& cells() const { return cells_; }
  const dual::CellVertices& vertices() const { return vertices_; }
  const dual::CellFacts& facts() const { return proof_.facts; }
  const std::string& name_of_region(std::int32_t region) const {
    return mesh_.names().regions[static_cast<std::size_t>(region - 1)];
  }

  /// Returns the plan of a file with what the proof says.
  FilePlan proved(FilePlan plan) const;

private:
  const ExchangeMesh& mesh_;
  dual::Cells cells_;
  dual::CellVertices vertices_;
  dual::CellProof proof_;
};

/// Returns rows for which append(site, surroundings, text) is called, once for each site of this rank. The rows keep
/// the cells.
template <class Append>
io::TextRows site_rows(const std::shared_ptr<const CellMesh>& mesh, const Append& append) {
  return {
      mesh->cells().site_count, [mesh, append](std::int64_t row, std::string& text) {
        thread_local dual::Surroundings around; // a buffer, since memory for each row would take a quarter of the time
        const auto site = static_cast<LocalIndex>(row);
        dual::look_around(mesh->cells(), site, around);
        append(site, around, text);
      }};
}

/// @brief Returns rows for which append(number, place, text) is called, once for each vertex: of whole cells, or also
/// those of parts of cells.
template <class Append>
std::vector<io::TextRows> vertex_rows(const std::shared_ptr<const CellMesh>& mesh, bool with_parts,
                                      const Append& append) {
  using dual::CellVertices;
  const mesh::DistributedMesh& triangles = mesh->mesh().mesh();
  std::vector<io::TextRows> rows{
      {std::ssize(triangles.triangles), [mesh, &triangles, append](std::int64_t row, std::string& text) {
         append(triangles.triangle_slab.first + row,
                dual::slab_centre(triangles, mesh->cells(), static_cast<std::size_t>(row)), text);
       }}};
  for (const auto group : {CellVertices::facet_middles, CellVertices::boundary_sites, CellVertices::interface_middles,
                           CellVertices::interface_sites})
    if (with_parts || group < CellVertices::interface_middles)
      rows.push_back(
          {std::ssize(mesh->vertices().places(group)), [mesh, group, append](std::int64_t row, std::string& text) {
             append(mesh->vertices().first(group) + row, mesh->vertices().places(group)[static_cast<std::size_t>(row)],
                    text);
           }});
  return rows;
}

} // namespace trime::formats
