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
      std::int64_t of_site = 1;
      sums[corners] += std::ssize(cells.fan(site).triangles);
      if (cells.region_inside(site) == 0) { // its parts have three corners more than triangles
        dual::look_around(cells, site, around);
        of_site = std::ssize(dual::parts_of(around));
        sums[corners] += 3 * of_site;
      }
      sums[parts] += of_site;
      dual::for_each_end(cells, site, [&](LocalIndex end) { sums[faces] += has_face(site, end) ? 1 : 0; });
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

/// Looks around a site only if this is asked for: most cells lie inside of one region, and need no geometry.
class Sight {
public:
  explicit Sight(const dual::Cells& cells) : cells_(cells) {}
  const Surroundings& around(LocalIndex site) {
    dual::look_around(cells_, site, around_);
    return around_;
  }

private:
  const dual::Cells& cells_;
  Surroundings around_;
};

/// Returns rows. append(site, sight, list) makes those that belong to a site.
template <class Row, class Append>
io::ExtraRows rows_of_sites(const Shared& counted, Counted::Kind kind, const Append& append) {
  return {counted->first[kind], counted->before[kind].back(),
          [counted, kind, append](std::int64_t begin, std::int64_t count, std::byte* out) {
            const std::vector<std::int64_t>& before = counted->before[kind];
            auto site =
                static_cast<LocalIndex>(std::upper_bound(before.begin(), before.end(), begin) - before.begin() - 1);
            Sight sight(counted->cells);
            std::vector<Row> rows;
            for (std::int64_t row = begin; row < begin + count; ++site) {
              rows.clear();
              append(site, sight, rows);
              const std::int64_t skipped = row - before[at(site)];
              const std::int64_t taken = std::min(std::ssize(rows) - skipped, begin + count - row);
              std::memcpy(out + static_cast<std::size_t>(row - begin) * sizeof(Row), rows.data() + skipped,
                          static_cast<std::size_t>(taken) * sizeof(Row));
              row += taken;
            }
          }};
}

/// Returns rows with a value of each part of a cell: inside(site) for a cell inside of one region, and otherwise
/// value(site, around, part).
template <class Row, class Inside, class Value>
io::ExtraRows rows_of_parts(const Shared& counted, const Inside& inside, const Value& value) {
  return rows_of_sites<Row>(counted, Counted::parts,
                            [counted, inside, value](LocalIndex site, Sight& sight, std::vector<Row>& rows) {
                              if (counted->cells.region_inside(site) != 0) {
                                rows.push_back(inside(site));
                                return;
                              }
                              const Surroundings& around = sight.around(site);
                              for (const CellPart& part : dual::parts_of(around))
                                rows.push_back(value(site, around, part));
                            });
}

/// Returns rows with a value of each face whose first cell is that of the site.
template <class Row, class Value>
io::ExtraRows rows_of_faces(const Shared& counted, const Value& value) {
  return rows_of_sites<Row>(counted, Counted::faces,
                            [counted, value](LocalIndex site, Sight& sight, std::vector<Row>& rows) {
                              const Surroundings& around = sight.around(site);
                              for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
                                if (counted->has_face(site, around.ends[spoke]))
                                  rows.push_back(value(around, spoke));
                            });
}

/// Returns rows with a value of the two cells of each face: value(site, end).
template <class Row, class Value>
io::ExtraRows rows_of_neighbours(const Shared& counted, const Value& value) {
  return rows_of_sites<Row>(counted, Counted::faces, [counted, value](LocalIndex site, Sight&, std::vector<Row>& rows) {
    dual::for_each_end(counted->cells, site, [&](LocalIndex end) {
      if (counted->has_face(site, end))
        rows.push_back(value(site, end));
    });
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
      counted, Counted::parts, [counted](LocalIndex site, Sight& sight, std::vector<std::int64_t>& rows) {
        std::int64_t corner = counted->first[Counted::corners] + counted->before[Counted::corners][at(site)];
        if (counted->cells.region_inside(site) != 0) {
          rows.push_back(corner);
          return;
        }
        for (const CellPart& part : dual::parts_of(sight.around(site))) {
          rows.push_back(corner);
          corner += static_cast<std::int64_t>(part.triangles) + 3;
        }
      });
  io::ExtraRows end{parts, is_root ? 1 : 0, [corners](std::int64_t, std::int64_t count, std::byte* out) {
                      if (count > 0)
                        std::memcpy(out, &corners, sizeof corners);
                    }};
  return {"corner_first", io::ValueType::int64, 0, parts + 1, {std::move(starts), std::move(end)}};
}

/// Appends the vertices at the corners of the parts of a cell.
void append_corners(const Counted& counted, LocalIndex site, Sight& sight, std::vector<GlobalId>& rows) {
  if (counted.cells.region_inside(site) != 0) {
    for (const LocalIndex triangle : counted.cells.fan(site).triangles)
      rows.push_back(counted.cells.triangles[at(triangle)].number);
    return;
  }
  const Surroundings& around = sight.around(site);
  for (const CellPart& part : dual::parts_of(around))
    for (const dual::CellCorner& corner : counted.vertices.corners(around, site, part))
      rows.push_back(corner.vertex);
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
       {rows_of_sites<GlobalId>(counted, Counted::corners, [counted](LocalIndex site, Sight& sight, auto& rows) {
         append_corners(*counted, site, sight, rows);
       })}});
}

void add_values(const Shared& counted, io::ExtraGroup& group) {
  using enum io::ValueType;
  const std::int64_t parts = counted->totals[Counted::parts];
  const auto add = [&](const char* name, io::ValueType type, int columns, io::ExtraRows rows) {
    group.arrays.push_back({name, type, columns, parts, {std::move(rows)}});
  };
  const auto number = [counted](LocalIndex site) { return counted->cells.number_of(site); };
  add("sites", int64, 0,
      rows_of_parts<GlobalId>(
          counted, number, [number](LocalIndex site, const Surroundings&, const CellPart&) { return number(site); }));
  add("regions", int32, 0,
      rows_of_parts<std::int32_t>(
          counted, [counted](LocalIndex site) { return counted->cells.region_inside(site); },
          [](LocalIndex, const Surroundings&, const CellPart& part) { return part.region; }));
  add("areas", float64, 0,
      rows_of_parts<double>(
          counted, [counted](LocalIndex site) { return dual::moments_inside(counted->cells, site).area; },
          [](LocalIndex, const Surroundings& around, const CellPart& part) {
            return dual::moments_of(around, part).area;
          }));
  const auto place = [counted](LocalIndex site) { return counted->cells.points[at(site)]; };
  add("centroids", float64, 2,
      rows_of_parts<Vec2>(
          counted,
          [counted, place](LocalIndex site) {
            return place(site) + dual::moments_inside(counted->cells, site).centroid;
          },
          [place](LocalIndex site, const Surroundings& around, const CellPart& part) {
            return place(site) + dual::moments_of(around, part).centroid;
          }));
}

void add_faces(const Shared& counted, io::ExtraGroup& group) {
  using enum io::ValueType;
  const std::int64_t faces = counted->totals[Counted::faces];
  const auto add = [&](const char* name, io::ValueType type, int columns, io::ExtraRows rows) {
    group.arrays.push_back({name, type, columns, faces, {std::move(rows)}});
  };
  add("faces", int64, 2,
      rows_of_neighbours<std::array<GlobalId, 2>>(counted, [counted](LocalIndex site, LocalIndex end) {
        return std::array{counted->cells.number_of(site), counted->cells.number_of(end)};
      }));
  add("face_distances", float64, 0, rows_of_neighbours<double>(counted, [counted](LocalIndex site, LocalIndex end) {
        const dual::Cells& cells = counted->cells;
        return length(dual::difference(cells.points[at(end)], cells.points[at(site)], cells.period));
      }));
  add("face_lengths", float64, 2,
      rows_of_faces<std::array<double, 2>>(counted, [](const Surroundings& around, std::size_t spoke) {
        return dual::face_of(around, spoke).dual_lengths;
      }));
  add("face_regions", int32, 2,
      rows_of_sites<std::array<std::int32_t, 2>>(
          counted, Counted::faces, [counted](LocalIndex site, Sight& sight, auto& rows) {
            if (const std::int32_t region = counted->cells.region_inside(site); region != 0) {
              dual::for_each_end(counted->cells, site, [&](LocalIndex end) {
                if (counted->has_face(site, end))
                  rows.push_back({region, 0});
              });
              return;
            }
            const Surroundings& around = sight.around(site);
            for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
              if (counted->has_face(site, around.ends[spoke]))
                rows.push_back(dual::face_of(around, spoke).regions);
          }));
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
