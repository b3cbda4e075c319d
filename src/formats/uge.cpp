// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells or triangles as an explicit unstructured grid of PFLOTRAN (user's guide, "GRID,
// UNSTRUCTURED_EXPLICIT"): one layer of thickness 1. The file lists the cells with their volumes, and the connections
// between them with the place where the line between both centres crosses the face, and the area of the face. Each part
// of the boundary has a file with its connections. A boundary edge has one for its triangle, or two for Voronoi cells:
// one for the cell at each end, in the middle of its half of the edge.
#include "comm/outbox.hpp"
#include "formats/named_cells.hpp"
#include "formats/rows_by_number.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trime::formats {
namespace {

/// A boundary edge seen from one of its ends.
struct HalfFacet {
  GlobalId site, other;
  std::int64_t part; // from 1
};

/// The boundary edges at the sites of this rank that have a face, by site, and by the other end at one site.
std::vector<HalfFacet> half_facets(const FlowCells& cells) {
  const CellMesh& all = *cells.mesh();
  const mesh::DistributedMesh& mesh = all.mesh().mesh();
  comm::Outbox<HalfFacet> away;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    for (const std::size_t end : {0, 1}) {
      const GlobalId site = mesh.facets[k][end], other = mesh.facets[k][1 - end];
      if (!cells.are_triangles() || site < other)
        away[all.cells().shares.rank_of(site)].push_back({site, other, mesh.facet_parts[k] + 1});
    }
  std::vector<HalfFacet> halves;
  for (const comm::Message& message : comm::send(all.mesh().comm(), away)) {
    const std::vector<HalfFacet> arrived = comm::from_bytes<HalfFacet>(message.data);
    halves.insert(halves.end(), arrived.begin(), arrived.end());
  }
  std::sort(halves.begin(), halves.end(), [](const HalfFacet& a, const HalfFacet& b) {
    return a.site != b.site ? a.site < b.site : a.other < b.other;
  });
  return halves;
}

FilePlan grid_file(const FlowCells& cells, const ExchangeMesh& mesh, const std::string& path) {
  return {path,
          {mesh.once(fmt::format("CELLS {}\n", cells.count())),
           cells.cell_rows([](const FlowCell& cell, std::string& to) {
             append_line(to, cell.number + 1, cell.centre.x, cell.centre.y, std::int64_t{0}, cell.area);
           }),
           mesh.once(fmt::format("CONNECTIONS {}\n", cells.face_count())),
           cells.face_rows([](const FlowFace& face, std::string& to) {
             append_line(to, face.cells[0] + 1, face.cells[1] + 1, face.place.x, face.place.y, std::int64_t{0},
                         face.length);
           })}};
}

} // namespace

std::vector<FilePlan> plan_uge(const ExchangeMesh& mesh, const std::string& path) {
  const auto cells = std::make_shared<const FlowCells>(mesh);
  std::vector<FilePlan> files{cells->proved(grid_file(*cells, mesh, path))};
  const auto halves = std::make_shared<const std::vector<HalfFacet>>(half_facets(*cells));
  const std::size_t labels = mesh.line_names().size();
  const auto by_part = std::make_shared<const RowsByNumber>(
      std::ssize(*halves), labels, [&](std::int64_t row) { return (*halves)[static_cast<std::size_t>(row)].part; });
  std::vector<std::int64_t> counts;
  for (std::size_t part = 1; part <= mesh.names().parts.size(); ++part)
    counts.push_back(by_part->count(part));
  mesh.comm().sum(counts);
  const std::vector<std::string> paths = paths_of(Format::uge, path, mesh.names());
  for (std::size_t part = 0; part < counts.size(); ++part)
    files.push_back({paths[part + 1],
                     {mesh.once(fmt::format("CONNECTIONS {}\n", counts[part])),
                      rows_of_number(by_part, part + 1, [cells, halves](std::int64_t row, std::string& to) {
                        const HalfFacet& half = (*halves)[static_cast<std::size_t>(row)];
                        if (const auto face = cells->boundary_face(half.site, half.other))
                          append_line(to, face->cells[0] + 1, face->place.x, face->place.y, std::int64_t{0},
                                      face->length);
                      })}});
  files.push_back(plan_named_cells(*cells, paths.back(), append_cell_number));
  return files;
}

} // namespace trime::formats
