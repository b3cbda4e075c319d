// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cells as an explicit unstructured grid of PFLOTRAN (user's guide, "GRID, UNSTRUCTURED_EXPLICIT"): one
// layer of thickness 1. The file lists the cells with their volumes, and the connections between them with the middle
// of the line between both sites and the area of the face. Each part of the boundary has a file with its connections:
// two for each boundary edge, one for the cell at each end, in the middle of its half of the edge.
#include "comm/outbox.hpp"
#include "formats/cell_mesh.hpp"
#include "formats/rows_by_number.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trime::formats {
namespace {

using dual::Surroundings;
using geometry::Vec2;

constexpr double least_face = 1e-9; // of the edge that it crosses; smaller faces are left out

/// The half of a boundary edge at one of its ends.
struct HalfFacet {
  GlobalId site, other;
  std::int64_t part; // from 1
};

/// The halves at the sites of this rank, by site, and by the other end at one site.
std::vector<HalfFacet> half_facets(const CellMesh& cells) {
  const mesh::DistributedMesh& mesh = cells.mesh().mesh();
  comm::Outbox<HalfFacet> away;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    for (const std::size_t end : {0, 1}) {
      const GlobalId site = mesh.facets[k][end];
      away[cells.cells().shares.rank_of(site)].push_back({site, mesh.facets[k][1 - end], mesh.facet_parts[k] + 1});
    }
  std::vector<HalfFacet> halves;
  for (const comm::Message& message : comm::send(cells.mesh().comm(), away)) {
    const std::vector<HalfFacet> arrived = comm::from_bytes<HalfFacet>(message.data);
    halves.insert(halves.end(), arrived.begin(), arrived.end());
  }
  std::sort(halves.begin(), halves.end(), [](const HalfFacet& a, const HalfFacet& b) {
    return a.site != b.site ? a.site < b.site : a.other < b.other;
  });
  return halves;
}

/// Calls use(spoke, face) for each connection that belongs to a site: those to neighbours with higher numbers.
template <class Use>
void for_each_connection(const dual::Cells& cells, LocalIndex site, const Surroundings& around, const Use& use) {
  for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
    if (cells.number_of(site) < cells.number_of(around.ends[spoke])) {
      const dual::CellFace face = dual::face_of(around, spoke);
      if (face.dual_length() > least_face * face.length)
        use(spoke, face);
    }
}

std::int64_t count_connections(const CellMesh& mesh) {
  const dual::Cells& cells = mesh.cells();
  std::int64_t count = 0;
  comm::run_agreed(mesh.mesh().comm(), [&] {
    Surroundings around;
    for (LocalIndex site = 0; site < cells.site_count; ++site) {
      dual::look_around(cells, site, around);
      for_each_connection(cells, site, around, [&](std::size_t, const dual::CellFace&) { ++count; });
    }
  });
  return mesh.mesh().comm().sum(count);
}

FilePlan grid_file(const std::shared_ptr<const CellMesh>& mesh, const std::string& path) {
  return {path,
          {mesh->mesh().once(fmt::format("CELLS {}\n", mesh->mesh().points())),
           site_rows(mesh,
                     [mesh](LocalIndex site, const Surroundings& around, std::string& to) {
                       const Vec2 place = mesh->cells().points[at(site)];
                       double area = 0;
                       for (const dual::CellPart& part : dual::parts_of(around))
                         area += dual::moments_of(dual::corners_of(around, part)).area;
                       append_line(to, mesh->cells().number_of(site) + 1, place.x, place.y, std::int64_t{0}, area);
                     }),
           mesh->mesh().once(fmt::format("CONNECTIONS {}\n", count_connections(*mesh))),
           site_rows(mesh, [mesh](LocalIndex site, const Surroundings& around, std::string& to) {
             const dual::Cells& cells = mesh->cells();
             for_each_connection(cells, site, around, [&](std::size_t spoke, const dual::CellFace& face) {
               const Vec2 middle = cells.points[at(site)] + around.middle(spoke);
               append_line(to, cells.number_of(site) + 1, cells.number_of(around.ends[spoke]) + 1, middle.x, middle.y,
                           std::int64_t{0}, face.dual_length());
             });
           })}};
}

void append_half(const CellMesh& mesh, const HalfFacet& half, std::string& to) {
  const dual::Cells& cells = mesh.cells();
  const auto site = static_cast<LocalIndex>(half.site - cells.first_site);
  Surroundings around;
  dual::look_around(cells, site, around);
  for (const std::size_t spoke : {std::size_t{0}, around.ends.size() - 1})
    if (cells.number_of(around.ends[spoke]) == half.other) {
      const Vec2 place = cells.points[at(site)] + 0.25 * around.arms[spoke];
      append_line(to, half.site + 1, place.x, place.y, std::int64_t{0}, 0.5 * length(around.arms[spoke]));
    }
}

} // namespace

std::vector<FilePlan> plan_uge(const ExchangeMesh& mesh, const std::string& path) {
  const auto cells = std::make_shared<const CellMesh>(mesh);
  std::vector<FilePlan> files{cells->proved(grid_file(cells, path))};
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
                        append_half(*cells, (*halves)[static_cast<std::size_t>(row)], to);
                      })}});
  return files;
}

} // namespace trime::formats
