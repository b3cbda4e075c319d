// SPDX-License-Identifier: BSD-3-Clause
// Gives the cells of a two-point flux to the writers of formats: the Voronoi cells of the points with the points as
// centres, or the triangles with their circumcentres as centres. In both cases the line between two centres is
// perpendicular to the face. Cells are in one layer of thickness 1.
#pragma once

#include "formats/cell_mesh.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace trime::formats {

/// A cell; numbers count from 0.
struct FlowCell {
  GlobalId number;
  geometry::Vec2 centre;
  double area;
  std::int32_t region; ///< a Voronoi cell in several regions has that of its largest share
};

/// A face between two cells, or half of a boundary edge or a whole one, which has one cell.
struct FlowFace {
  std::array<GlobalId, 2> cells;   ///< numbers; the second one of a boundary edge is -1
  geometry::Vec2 place;            ///< where the line between the centres crosses the face
  double length;                   ///< length of the face
  std::array<double, 2> distances; ///< from each centre to the face; negative if an obtuse triangle lies behind it
};

/// How much of an edge of the mesh lies in a cell, or at its rim.
struct CellLength {
  GlobalId cell;
  double length;
};

class FlowCells {
public:
  /// Makes the cells that Names::cells asks for. @pre the mesh outlives this object and its rows
  /// @throws FileError on all ranks if a point has no cell, or if the mesh has no triangle
  /// @note Collective.
  explicit FlowCells(const ExchangeMesh& mesh);

  bool are_triangles() const { return are_triangles_; }
  const std::shared_ptr<const CellMesh>& mesh() const { return mesh_; }
  GlobalId count() const; ///< number of cells over all ranks
  /// Returns the number of faces between cells over all ranks. Collective.
  std::int64_t face_count() const { return count_faces().faces; }

  /// Returns rows for which append(cell, text) is called, once for each cell in the order of numbers.
  template <class Append>
  io::TextRows cell_rows(const Append& append) const {
    if (!are_triangles_)
      return site_rows(mesh_,
                       [mesh = mesh_, append](LocalIndex site, const dual::Surroundings& around, std::string& text) {
                         append(cell_at(*mesh, site, around), text);
                       });
    return {std::ssize(mesh_->mesh().mesh().triangles),
            [mesh = mesh_, append](std::int64_t row, std::string& text) { append(triangle_at(*mesh, row), text); }};
  }
  /// Returns rows for which append(face, text) is called, once for each face between two cells.
  template <class Append>
  io::TextRows face_rows(const Append& append) const {
    return site_rows(mesh_, [mesh = mesh_, append, are_triangles = are_triangles_](
                                LocalIndex site, const dual::Surroundings& around, std::string& text) {
      for_each_face(*mesh, are_triangles, site, around, [&](const FlowFace& face) { append(face, text); });
    });
  }
  /// Returns the face of a site's cell on the boundary edge to another point; that of a triangle belongs to the end
  /// with the lower number. @pre the edge ends at a site of this rank
  std::optional<FlowFace> boundary_face(GlobalId site, GlobalId other) const;
  /// Returns the cells along an edge of the mesh: those of both ends, or the triangles on both sides, with half of its
  /// length each. A triangle at the boundary has the whole length. Nothing is returned if there is no such edge.
  /// @pre the edge ends at a site of this rank
  std::vector<CellLength> along_edge(GlobalId site, GlobalId other) const;

  /// Returns the plan of a file with what the proof says, and what is known of triangles as cells.
  FilePlan proved(FilePlan plan) const;

private:
  struct FaceCounts {
    std::int64_t faces = 0;
    std::int64_t same_centres = 0; ///< faces whose centres are nearer than a billionth of their length
    double nearest_centres = 0;    ///< least distance of centres over the length of their face
  };
  /// Holds what must be known of triangles as cells.
  struct TriangleFacts {
    std::int64_t obtuse = 0;
    double area = 0;
    double least_cosine = 1;    ///< least cosine of an angle
    geometry::Vec2 worst{0, 0}; ///< circumcentre of the triangle with the largest angle
    FaceCounts faces;
  };

  static FlowCell cell_at(const CellMesh& mesh, LocalIndex site, const dual::Surroundings& around);
  static FlowCell triangle_at(const CellMesh& mesh, std::int64_t row);
  static bool has_face(const FlowFace& face, bool are_triangles);
  static FlowFace face_at(const CellMesh& mesh, bool are_triangles, LocalIndex site, const dual::Surroundings& around,
                          std::size_t spoke);
  template <class Use>
  static void for_each_face(const CellMesh& mesh, bool are_triangles, LocalIndex site, const dual::Surroundings& around,
                            const Use& use) {
    for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
      if (mesh.cells().number_of(site) < mesh.cells().number_of(around.ends[spoke]))
        if (const FlowFace face = face_at(mesh, are_triangles, site, around, spoke); has_face(face, are_triangles))
          use(face);
  }
  FaceCounts count_faces() const;
  void find_facts();

  std::shared_ptr<const CellMesh> mesh_;
  bool are_triangles_;
  TriangleFacts facts_;
};

} // namespace trime::formats
