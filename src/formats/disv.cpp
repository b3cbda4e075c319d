// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells or triangles as a grid of MODFLOW 6 ("Discretization by Vertices", DISV, in Langevin et al. 2017, USGS
// Techniques and Methods 6-A55): one layer from 0 to 1 with clockwise cells. The site is the centre of a cell, since
// faces are perpendicular to the lines between sites. Vertices at one place are merged. A second file has the number of
// the region of each cell.
#include "dual/merged.hpp"
#include "formats/named_cells.hpp"
#include "formats/solver_names.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trime::formats {
namespace {

using dual::Surroundings;

constexpr std::int64_t most_disv_vertices = 30; // of a cell, for the particle tracker

struct DisvCells {
  std::shared_ptr<const CellMesh> mesh;
  dual::MergedVertices merged;

  explicit DisvCells(const std::shared_ptr<const CellMesh>& cells)
      : mesh(cells), merged(cells->cells(), cells->vertices(), cells->mesh().comm()) {}
};

void append_cell(const DisvCells& cells, LocalIndex site, const Surroundings& around, std::string& to) {
  std::vector<dual::CellCorner> corners = cells.merged.corners(around, site, dual::whole_cell(around));
  std::reverse(corners.begin(), corners.end());
  const geometry::Vec2 place = cells.mesh->cells().points[at(site)];
  to += "  ";
  append_line(to, cells.mesh->cells().number_of(site) + 1, place.x, place.y, std::ssize(corners));
  to.back() = ' ';
  for (const dual::CellCorner& corner : corners) {
    io::append_number(to, corner.vertex + 1);
    to += ' ';
  }
  to.back() = '\n';
}

std::string head_of(const ExchangeMesh& mesh, const char* what, GlobalId cells, GlobalId vertices) {
  std::string text = fmt::format("# {} by trime_mpi\n", what);
  for (std::size_t k = 0; k < mesh.names().regions.size(); ++k)
    text += fmt::format("# zone {} is region {}\n", k + 1, in_comment(mesh.names().regions[k]));
  return text + fmt::format("BEGIN OPTIONS\nEND OPTIONS\n\nBEGIN DIMENSIONS\n  NLAY 1\n  NCPL {}\n  NVERT {}\n"
                            "END DIMENSIONS\n\nBEGIN GRIDDATA\n  TOP\n    CONSTANT 1.0\n  BOTM LAYERED\n    CONSTANT "
                            "0.0\nEND GRIDDATA\n\nBEGIN VERTICES\n",
                            cells, vertices);
}

/// The grid, the region of each cell, and the cells along named lines.
std::vector<FilePlan> disv_files(const FlowCells& cells, FilePlan grid, const io::TextRows& zones) {
  const std::vector<std::string> paths = paths_of(Format::disv, grid.path, cells.mesh()->mesh().names());
  return {cells.proved(std::move(grid)), {paths[1], {zones}}, plan_named_cells(cells, paths[2], append_cell_number)};
}

/// Triangles with their circumcentres as centres; the vertices are the points.
std::vector<FilePlan> plan_disv_triangles(const ExchangeMesh& mesh, const std::string& path) {
  const FlowCells cells(mesh);
  const auto all = cells.mesh();
  const std::vector<io::TextRows> rows{
      mesh.once(head_of(mesh, "Triangles", mesh.triangles(), mesh.points())),
      mesh.point_rows([](std::int64_t, GlobalId number, geometry::Vec2 place, std::string& to) {
        to += "  ";
        append_line(to, number + 1, place.x, place.y);
      }),
      mesh.once("END VERTICES\n\nBEGIN CELL2D\n"),
      mesh.triangle_rows(
          [all](std::int64_t row, GlobalId number, const std::array<GlobalId, 3>& corners, std::string& to) {
            const geometry::Vec2 centre =
                dual::slab_centre(all->mesh().mesh(), all->cells(), static_cast<std::size_t>(row));
            to += "  ";
            append_line(to, number + 1, centre.x, centre.y, std::int64_t{3}, corners[2] + 1, corners[1] + 1,
                        corners[0] + 1);
          }),
      mesh.once("END CELL2D\n")};
  const auto zones =
      cells.cell_rows([](const FlowCell& cell, std::string& to) { append_line(to, std::int64_t{cell.region}); });
  return disv_files(cells, {path, rows}, zones);
}

std::vector<FilePlan> plan_disv_voronoi(const ExchangeMesh& mesh, const std::string& path) {
  const FlowCells all(mesh);
  const std::shared_ptr<const CellMesh>& cells = all.mesh();
  if (cells->facts().most_corners > most_disv_vertices) // all ranks find the same
    throw FileError(fmt::format("a Voronoi cell has {} vertices; expected at most {}, as MODFLOW 6 allows; make the "
                                "triangles more equal, for example with a smaller gradation of the size",
                                cells->facts().most_corners, most_disv_vertices));
  const auto disv = std::make_shared<const DisvCells>(cells);
  std::vector<io::TextRows> rows{
      mesh.once(head_of(mesh, "Voronoi cells", mesh.points(), cells->vertices().whole_count()))};
  for (io::TextRows& vertices : vertex_rows(cells, false, [](GlobalId number, geometry::Vec2 place, std::string&to) {
         to += "  ";
         append_line(to, number + 1, place.x, place.y);
       }))
    rows.push_back(std::move(vertices));
  rows.push_back(mesh.once("END VERTICES\n\nBEGIN CELL2D\n"));
  rows.push_back(site_rows(cells, [disv](LocalIndex site, const Surroundings& around, std::string& to) {
    append_cell(*disv, site, around, to);
  }));
  rows.push_back(mesh.once("END CELL2D\n"));
  const auto zones = site_rows(cells, [](LocalIndex, const Surroundings& around, std::string& to) {
    append_line(to, std::int64_t{dual::whole_cell(around).region});
  });
  return disv_files(all, {path, rows}, zones);
}

} // namespace

std::vector<FilePlan> plan_disv(const ExchangeMesh& mesh, const std::string& path) {
  return mesh.names().cells == CellKind::triangles ? plan_disv_triangles(mesh, path) : plan_disv_voronoi(mesh, path);
}

} // namespace trime::formats
