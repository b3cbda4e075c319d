// SPDX-License-Identifier: BSD-3-Clause
// UGRID 1.0 (the conventions for unstructured grids in netCDF): a two-dimensional mesh whose faces are triangles, or
// Voronoi cells. The files are in a classic netCDF format, which all programs with a netCDF library read.
#include "comm/agree.hpp"
#include "formats/cell_mesh.hpp"
#include "formats/netcdf_header.hpp"
#include "io/point_lookup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace trime::formats {
namespace {

using dual::CellPart;
using dual::Surroundings;
using geometry::Vec2;

constexpr std::int64_t no_node = -1; // behind the last corner of a face

void append_id(std::string& to, GlobalId id, NetcdfType type) {
  if (type == NetcdfType::int64)
    append_big(to, std::int64_t{id});
  else
    append_big(to, static_cast<std::int32_t>(id));
}

/// CDF-2 as long as all numbers and arrays fit.
NetcdfFormat format_for(GlobalId nodes, GlobalId faces, std::int64_t most_corners) {
  constexpr std::int64_t most_bytes = (std::int64_t{1} << 32) - 4, most_ids = (std::int64_t{1} << 31) - 1;
  const bool fits = 8 * nodes <= most_bytes && 8 * faces <= most_bytes && 4 * most_corners * faces <= most_bytes &&
                    std::max(nodes, faces) <= most_ids;
  return fits ? NetcdfFormat::offset_64 : NetcdfFormat::data_64;
}

/// Collects the header and the arrays of a file. All names of the mesh begin with mesh2d.
class UgridFile {
public:
  UgridFile(const ExchangeMesh& mesh, NetcdfFormat format)
      : mesh_(mesh), header_(format),
        id_type_(format == NetcdfFormat::data_64 ? NetcdfType::int64 : NetcdfType::int32) {
    header_.attribute({"Conventions", std::string("CF-1.8 UGRID-1.0")});
    header_.attribute({"title", std::string("trime_mpi mesh")});
    if (!mesh.names().crs.empty())
      header_.attribute({"crs", mesh.names().crs});
  }

  /// Begins the mesh: the numbers of nodes and faces, and the variable that describes it.
  /// @param with_boundary the file lists boundary edges
  void begin(GlobalId nodes, GlobalId faces, std::int64_t most_corners, bool with_boundary) {
    nodes_ = header_.dimension("mesh2d_nNodes", nodes);
    faces_ = header_.dimension("mesh2d_nFaces", faces);
    corners_ = header_.dimension("mesh2d_nMax_face_nodes", most_corners);
    std::vector<NetcdfAttribute> attributes{{"cf_role", std::string("mesh_topology")},
                                            {"long_name", std::string("topology of the mesh")},
                                            {"topology_dimension", std::int32_t{2}},
                                            {"node_coordinates", std::string("mesh2d_node_x mesh2d_node_y")},
                                            {"node_dimension", std::string("mesh2d_nNodes")},
                                            {"face_node_connectivity", std::string("mesh2d_face_nodes")},
                                            {"face_dimension", std::string("mesh2d_nFaces")},
                                            {"face_coordinates", std::string("mesh2d_face_x mesh2d_face_y")}};
    if (with_boundary)
      attributes.push_back({"boundary_node_connectivity", std::string("mesh2d_boundary_nodes")});
    std::string value;
    append_big(value, std::int32_t{0});
    add({"mesh2d", NetcdfType::int32, {}, attributes}, {mesh_.once(value)});
  }

  /// Adds a pair of coordinates of nodes or faces. rows(append) makes rows that call append(place, text).
  template <class Rows>
  void coordinates(const std::string& location, const Rows& rows) {
    const std::size_t dimension = location == "node" ? nodes_ : faces_;
    add({"mesh2d_" + location + "_x", NetcdfType::float64, {dimension}, axis("x", location)},
        rows([](Vec2 p, std::string& to) { append_big(to, p.x); }));
    add({"mesh2d_" + location + "_y", NetcdfType::float64, {dimension}, axis("y", location)},
        rows([](Vec2 p, std::string& to) { append_big(to, p.y); }));
  }

  void face_nodes(const std::vector<io::TextRows>& rows) {
    add({"mesh2d_face_nodes", id_type_, {faces_, corners_}, connectivity("face_node_connectivity", true)}, rows);
  }

  /// Adds a variable with a value at each node or face.
  void data(const std::string& name, const std::string& location, NetcdfType type, const std::string& meaning,
            const std::vector<io::TextRows>& rows) {
    add({"mesh2d_" + name,
         type,
         {location == "node" ? nodes_ : faces_},
         {{"long_name", meaning},
          {"mesh", std::string("mesh2d")},
          {"location", location},
          {"coordinates", fmt::format("mesh2d_{0}_x mesh2d_{0}_y", location)}}},
        rows);
  }

  void boundary() {
    const mesh::DistributedMesh& part = mesh_.mesh();
    const std::size_t count = header_.dimension("mesh2d_nBoundaries", part.facet_slab.total),
                      two = header_.dimension("Two", 2);
    add({"mesh2d_boundary_nodes", id_type_, {count, two}, connectivity("boundary_node_connectivity", false)},
        {{std::ssize(part.facets), [type = id_type_, &part](std::int64_t row, std::string& to) {
            for (const GlobalId end : part.facets[static_cast<std::size_t>(row)])
              append_id(to, end, type);
          }}});
    add({"mesh2d_boundary_label", NetcdfType::int32, {count}, {{"long_name", numbered("label", mesh_.line_names())}}},
        {{std::ssize(part.facets), [&part](std::int64_t row, std::string& to) {
            append_big(to, part.facet_parts[static_cast<std::size_t>(row)] + 1);
          }}});
  }

  NetcdfType id_type() const { return id_type_; }

  /// Says which number has which name.
  static std::string numbered(const std::string& what, const std::vector<std::string>& names) {
    std::string text = what + ":";
    for (std::size_t k = 0; k < names.size(); ++k)
      text += fmt::format("{} {} = {}", k == 0 ? "" : ",", k + 1, names[k]);
    return text;
  }

  std::vector<io::TextRows> rows() const {
    std::vector<io::TextRows> rows{mesh_.once(header_.bytes())};
    rows.insert(rows.end(), rows_.begin(), rows_.end());
    return rows;
  }

private:
  std::vector<NetcdfAttribute> axis(const std::string& name, const std::string& location) const {
    const std::string of = location == "node" ? "nodes" : "faces";
    if (mesh_.names().crs.empty())
      return {{"long_name", name + " coordinate of " + of}};
    return {{"standard_name", fmt::format("projection_{}_coordinate", name)},
            {"long_name", name + " coordinate of " + of},
            {"units", std::string("m")}};
  }

  std::vector<NetcdfAttribute> connectivity(const std::string& role, bool may_be_short) const {
    std::vector<NetcdfAttribute> attributes{{"cf_role", role}, {"start_index", std::int32_t{0}}};
    if (!may_be_short)
      return attributes;
    if (id_type_ == NetcdfType::int64)
      attributes.push_back({"_FillValue", no_node});
    else
      attributes.push_back({"_FillValue", static_cast<std::int32_t>(no_node)});
    return attributes;
  }

  void add(NetcdfVariable variable, const std::vector<io::TextRows>& rows) {
    header_.variable(std::move(variable));
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    if (const std::size_t zeros = header_.padding(); zeros > 0)
      rows_.push_back(mesh_.once(std::string(zeros, '\0')));
  }

  const ExchangeMesh& mesh_;
  NetcdfHeader header_;
  NetcdfType id_type_;
  std::vector<io::TextRows> rows_;
  std::size_t nodes_ = 0, faces_ = 0, corners_ = 0; // dimensions
};

/// The centres of mass of the triangles of this rank.
std::vector<Vec2> triangle_centres(const ExchangeMesh& mesh) {
  const mesh::DistributedMesh& part = mesh.mesh();
  const io::PointLookup others(part, part.foreign, mesh.comm());
  const auto place = [&](LocalIndex p) {
    return at(p) < part.points.size() ? part.points[at(p)] : others[part.global_id(p)].position;
  };
  std::vector<Vec2> centres;
  for (const auto& [a, b, c] : part.triangles)
    centres.push_back((1.0 / 3) * (place(a) + place(b) + place(c)));
  return centres;
}

io::TextRows region_rows(const ExchangeMesh& mesh) {
  return {std::ssize(mesh.mesh().triangles),
          [&mesh](std::int64_t row, std::string& to) { append_big(to, static_cast<std::int32_t>(mesh.region(row))); }};
}

/// The largest number of corners of a polygon over all ranks.
std::int64_t most_corners(const CellMesh& cells, const comm::Communicator& comm) {
  std::int64_t most = 3;
  comm::run_agreed(comm, [&] {
    Surroundings around;
    for (LocalIndex site = 0; site < cells.cells().site_count; ++site) {
      dual::look_around(cells.cells(), site, around);
      for (const CellPart& part : dual::parts_of(around))
        most = std::max(most, static_cast<std::int64_t>(part.triangles) + (part.is_round ? 0 : 3));
    }
  });
  return comm.max(most);
}

/// Rows with append(part, around, site, text) for each part of each cell.
template <class Append>
std::vector<io::TextRows> part_rows(const std::shared_ptr<const CellMesh>& cells, const Append& append) {
  return {site_rows(cells, [append](LocalIndex site, const Surroundings& around, std::string& to) {
    for (const CellPart& part : dual::parts_of(around))
      append(part, around, site, to);
  })};
}

void add_cells(UgridFile& file, const std::shared_ptr<const CellMesh>& cells, std::int64_t most) {
  const NetcdfType type = file.id_type();
  file.coordinates("node", [&](const auto& append) {
    return vertex_rows(cells, true, [append](GlobalId, Vec2 place, std::string& to) { append(place, to); });
  });
  file.coordinates("face", [&](const auto& append) {
    return part_rows(cells, [cells, append](const CellPart&, const Surroundings&, LocalIndex site, std::string& to) {
      append(cells->cells().points[at(site)], to);
    });
  });
  file.face_nodes(part_rows(
      cells, [cells, type, most](const CellPart& part, const Surroundings& around, LocalIndex site, std::string& to) {
        const std::vector<dual::CellCorner> corners = cells->vertices().corners(around, site, part);
        for (std::int64_t k = 0; k < most; ++k)
          append_id(to, k < std::ssize(corners) ? corners[static_cast<std::size_t>(k)].vertex : no_node, type);
      }));
}

void add_cell_values(UgridFile& file, const std::shared_ptr<const CellMesh>& cells) {
  file.data("region", "face", NetcdfType::int32, UgridFile::numbered("region", cells->mesh().names().regions),
            part_rows(cells, [](const CellPart& part, const Surroundings&, LocalIndex, std::string& to) {
              append_big(to, part.region);
            }));
  file.data("area", "face", NetcdfType::float64, "area of the face",
            part_rows(cells, [](const CellPart& part, const Surroundings& around, LocalIndex, std::string& to) {
              append_big(to, dual::moments_of(around, part).area);
            }));
  file.data("site", "face", file.id_type(), "number of the point of the mesh in the cell",
            part_rows(cells, [cells, type = file.id_type()](const CellPart&, const Surroundings&, LocalIndex site,
                                                            std::string& to) {
              append_id(to, cells->cells().number_of(site), type);
            }));
}

} // namespace

std::vector<FilePlan> plan_ugrid(const ExchangeMesh& mesh, const std::string& path) {
  const mesh::DistributedMesh& part = mesh.mesh();
  const auto centres = std::make_shared<const std::vector<Vec2>>(triangle_centres(mesh));
  UgridFile file(mesh, format_for(mesh.points(), mesh.triangles(), 3));
  file.begin(mesh.points(), mesh.triangles(), 3, part.facet_slab.total > 0);
  file.coordinates("node", [&](const auto& append) {
    return std::vector{
        mesh.point_rows([append](std::int64_t, GlobalId, Vec2 place, std::string& to) { append(place, to); })};
  });
  file.coordinates("face", [&](const auto& append) {
    return std::vector<io::TextRows>{{std::ssize(*centres), [centres, append](std::int64_t row, std::string& to) {
                                        append((*centres)[static_cast<std::size_t>(row)], to);
                                      }}};
  });
  file.face_nodes({mesh.triangle_rows(
      [type = file.id_type()](std::int64_t, GlobalId, const std::array<GlobalId, 3>& ids, std::string& to) {
        for (const GlobalId id : ids)
          append_id(to, id, type);
      })});
  file.data("region", "face", NetcdfType::int32, UgridFile::numbered("region", mesh.names().regions),
            {region_rows(mesh)});
  file.data("size", "node", NetcdfType::float32, "target edge length",
            {{std::ssize(part.size), [&part](std::int64_t row, std::string& to) {
                append_big(to, part.size[static_cast<std::size_t>(row)]);
              }}});
  if (part.depth)
    file.data("node_z", "node", NetcdfType::float64, "height of the bed",
              {{std::ssize(*part.depth), [&part](std::int64_t row, std::string& to) {
                  append_big(to, -(*part.depth)[static_cast<std::size_t>(row)]);
                }}});
  if (part.facet_slab.total > 0)
    file.boundary();
  return {{path, file.rows()}};
}

std::vector<FilePlan> plan_ugrid_cells(const ExchangeMesh& mesh, const std::string& path) {
  const auto cells = std::make_shared<const CellMesh>(mesh);
  const std::int64_t most = most_corners(*cells, mesh.comm());
  const GlobalId nodes = cells->vertices().count(), faces = cells->facts().parts;
  UgridFile file(mesh, format_for(nodes, faces, most));
  file.begin(nodes, faces, most, false);
  add_cells(file, cells, most);
  add_cell_values(file, cells);
  return {cells->proved({path, file.rows()})};
}

} // namespace trime::formats
