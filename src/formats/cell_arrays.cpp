// SPDX-License-Identifier: BSD-3-Clause
#include "formats/cell_arrays.hpp"

#include "comm/agree.hpp"
#include "dual/proof.hpp"
#include "dual/vertices.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

namespace trime::formats {
namespace {

using dual::CellPart;
using dual::CellVertices;
using dual::Surroundings;
using geometry::Vec2;

/// The cells and what is counted before each site of this rank.
struct Counted {
  Counted(const mesh::DistributedMesh& with, Vec2 period, const comm::Communicator& comm)
      : mesh(with), cells(dual::make_cells(with, period, comm)), vertices(cells, comm) {
    comm::run_agreed(comm, [&] { count(); });
    for (std::size_t k = 0; k < 3; ++k) {
      totals[k] = before[k].back();
      first[k] = comm.exclusive_scan(totals[k]);
    }
    comm.sum(totals);
  }

  bool has_face(LocalIndex site, LocalIndex end) const { return cells.number_of(site) < cells.number_of(end); }

  void count() {
    std::array<std::int64_t, 3> sums{};
    Surroundings around;
    for (auto& list : before)
      list.push_back(0);
    for (LocalIndex site = 0; site < cells.site_count; ++site) {
      dual::look_around(cells, site, around);
      for (const CellPart& part : dual::parts_of(around)) {
        ++sums[parts];
        sums[corners] += static_cast<std::int64_t>(part.triangles) + (part.is_round ? 0 : 3);
      }
      sums[faces] +=
          std::count_if(around.ends.begin(), around.ends.end(), [&](LocalIndex end) { return has_face(site, end); });
      for (std::size_t k = 0; k < 3; ++k)
        before[k].push_back(sums[k]);
    }
  }

  enum Kind : std::size_t { parts, corners, faces };

  const mesh::DistributedMesh& mesh;
  dual::Cells cells;
  CellVertices vertices;
  std::array<std::vector<std::int64_t>, 3> before; ///< by kind: [sites + 1], counts on this rank before each site
  std::array<std::int64_t, 3> first{};             ///< by kind: count on the ranks before this one
  std::array<std::int64_t, 3> totals{};            ///< by kind, over all ranks
};

using Shared = std::shared_ptr<const Counted>;

/// Returns rows. append(site, around, list) makes those that belong to a site.
template <class Row, class Append>
io::ExtraRows rows_of_sites(const Shared& counted, Counted::Kind kind, const Append& append) {
  return {counted->first[kind], counted->before[kind].back(),
          [counted, kind, append](std::int64_t begin, std::int64_t count, std::byte* out) {
            const std::vector<std::int64_t>& before = counted->before[kind];
            auto site =
                static_cast<LocalIndex>(std::upper_bound(before.begin(), before.end(), begin) - before.begin() - 1);
            Surroundings around;
            std::vector<Row> rows;
            for (std::int64_t row = begin; row < begin + count; ++site) {
              rows.clear();
              dual::look_around(counted->cells, site, around);
              append(site, around, rows);
              const std::int64_t skipped = row - before[at(site)];
              const std::int64_t taken = std::min(std::ssize(rows) - skipped, begin + count - row);
              std::memcpy(out + static_cast<std::size_t>(row - begin) * sizeof(Row), rows.data() + skipped,
                          static_cast<std::size_t>(taken) * sizeof(Row));
              row += taken;
            }
          }};
}

/// Returns rows with a value of each part of a cell.
template <class Row, class Value>
io::ExtraRows rows_of_parts(const Shared& counted, const Value& value) {
  return rows_of_sites<Row>(counted, Counted::parts,
                            [value](LocalIndex site, const Surroundings& around, std::vector<Row>& rows) {
                              for (const CellPart& part : dual::parts_of(around))
                                rows.push_back(value(site, around, part));
                            });
}

/// Returns rows with a value of each face whose first cell is that of the site.
template <class Row, class Value>
io::ExtraRows rows_of_faces(const Shared& counted, const Value& value) {
  return rows_of_sites<Row>(counted, Counted::faces,
                            [counted, value](LocalIndex site, const Surroundings& around, std::vector<Row>& rows) {
                              for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
                                if (counted->has_face(site, around.ends[spoke]))
                                  rows.push_back(value(site, around, spoke));
                            });
}

io::ExtraArray vertex_array(const Shared& counted) {
  const mesh::DistributedMesh& mesh = counted->mesh;
  io::ExtraArray array{"vertices", io::ValueType::float64, 2, counted->vertices.count(), {}};
  array.blocks.push_back({mesh.triangle_slab.first, std::ssize(mesh.triangles),
                          [counted](std::int64_t begin, std::int64_t count, std::byte* out) {
                            for (std::int64_t k = 0; k < count; ++k) {
                              const Vec2 centre =
                                  dual::slab_centre(counted->mesh, counted->cells, static_cast<std::size_t>(begin + k));
                              std::memcpy(out + static_cast<std::size_t>(k) * sizeof centre, &centre, sizeof centre);
                            }
                          }});
  for (const auto group : {CellVertices::facet_middles, CellVertices::boundary_sites, CellVertices::interface_middles,
                           CellVertices::interface_sites})
    if (counted->vertices.count(group) > 0)
      array.blocks.push_back({counted->vertices.first(group), std::ssize(counted->vertices.places(group)),
                              [counted, group](std::int64_t begin, std::int64_t count, std::byte* out) {
                                std::memcpy(out, counted->vertices.places(group).data() + begin,
                                            static_cast<std::size_t>(count) * sizeof(Vec2));
                              }});
  return array;
}

/// The first corner of each polygon, and the number of all corners.
io::ExtraArray first_corners(const Shared& counted, bool is_root) {
  const std::int64_t parts = counted->totals[Counted::parts], corners = counted->totals[Counted::corners];
  io::ExtraRows starts = rows_of_sites<std::int64_t>(
      counted, Counted::parts, [counted](LocalIndex site, const Surroundings& around, std::vector<std::int64_t>& rows) {
        std::int64_t corner = counted->first[Counted::corners] + counted->before[Counted::corners][at(site)];
        for (const CellPart& part : dual::parts_of(around)) {
          rows.push_back(corner);
          corner += static_cast<std::int64_t>(part.triangles) + (part.is_round ? 0 : 3);
        }
      });
  io::ExtraRows end{parts, is_root ? 1 : 0, [corners](std::int64_t, std::int64_t count, std::byte* out) {
                      if (count > 0)
                        std::memcpy(out, &corners, sizeof corners);
                    }};
  return {"corner_first", io::ValueType::int64, 0, parts + 1, {std::move(starts), std::move(end)}};
}

void add_polygons(const Shared& counted, bool is_root, io::ExtraGroup& group) {
  using enum io::ValueType;
  group.arrays.push_back(vertex_array(counted));
  group.arrays.push_back(first_corners(counted, is_root));
  group.arrays.push_back(
      {"corners",
       int64,
       0,
       counted->totals[Counted::corners],
       {rows_of_sites<GlobalId>(counted, Counted::corners,
                                [counted](LocalIndex site, const Surroundings& around, std::vector<GlobalId>& rows) {
                                  for (const CellPart& part : dual::parts_of(around))
                                    for (const dual::CellCorner& corner : counted->vertices.corners(around, site, part))
                                      rows.push_back(corner.vertex);
                                })}});
}

void add_values(const Shared& counted, io::ExtraGroup& group) {
  using enum io::ValueType;
  const std::int64_t parts = counted->totals[Counted::parts];
  group.arrays.push_back(
      {"sites",
       int64,
       0,
       parts,
       {rows_of_parts<GlobalId>(counted, [counted](LocalIndex site, const Surroundings&, const CellPart&) {
         return counted->cells.number_of(site);
       })}});
  group.arrays.push_back({"regions",
                          int32,
                          0,
                          parts,
                          {rows_of_parts<std::int32_t>(counted, [](LocalIndex, const Surroundings&,
                                                                   const CellPart& part) { return part.region; })}});
  group.arrays.push_back(
      {"areas",
       float64,
       0,
       parts,
       {rows_of_parts<double>(counted, [](LocalIndex, const Surroundings& around, const CellPart& part) {
         return dual::moments_of(dual::corners_of(around, part)).area;
       })}});
  group.arrays.push_back(
      {"centroids",
       float64,
       2,
       parts,
       {rows_of_parts<Vec2>(counted, [counted](LocalIndex site, const Surroundings& around, const CellPart& part) {
         return counted->cells.points[at(site)] + dual::moments_of(dual::corners_of(around, part)).centroid;
       })}});
}

void add_faces(const Shared& counted, io::ExtraGroup& group) {
  using enum io::ValueType;
  const std::int64_t faces = counted->totals[Counted::faces];
  group.arrays.push_back(
      {"faces",
       int64,
       2,
       faces,
       {rows_of_faces<std::array<GlobalId, 2>>(
           counted, [counted](LocalIndex site, const Surroundings& around, std::size_t spoke) {
             return std::array{counted->cells.number_of(site), counted->cells.number_of(around.ends[spoke])};
           })}});
  group.arrays.push_back(
      {"face_distances",
       float64,
       0,
       faces,
       {rows_of_faces<double>(counted, [](LocalIndex, const Surroundings& around, std::size_t spoke) {
         return length(around.arms[spoke]);
       })}});
  group.arrays.push_back(
      {"face_lengths",
       float64,
       2,
       faces,
       {rows_of_faces<std::array<double, 2>>(counted, [](LocalIndex, const Surroundings& around, std::size_t spoke) {
         return dual::face_of(around, spoke).dual_lengths;
       })}});
  group.arrays.push_back({"face_regions",
                          int32,
                          2,
                          faces,
                          {rows_of_faces<std::array<std::int32_t, 2>>(
                              counted, [](LocalIndex, const Surroundings& around, std::size_t spoke) {
                                return dual::face_of(around, spoke).regions;
                              })}});
}

} // namespace

io::ExtraGroup cell_arrays(const mesh::DistributedMesh& mesh, Vec2 period, const comm::Communicator& comm) {
  const auto counted = std::make_shared<const Counted>(mesh, period, comm);
  io::ExtraGroup group{"/Cells", {{"cells", mesh.point_slab.total}, {"parts", counted->totals[Counted::parts]}}, {}};
  add_polygons(counted, comm.is_root(), group);
  add_values(counted, group);
  add_faces(counted, group);
  return group;
}

mesh::Checks cell_checks(const mesh::DistributedMesh& mesh, Vec2 period, std::size_t regions,
                         const comm::Communicator& comm) {
  const dual::Cells cells = dual::make_cells(mesh, period, comm);
  return dual::prove(mesh, cells, regions, comm).checks;
}

} // namespace trime::formats
