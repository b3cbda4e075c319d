// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cells as a planar mesh of MPAS ("MPAS Mesh Specification", version 1.0): cells, edges between them, and
// vertices where cells meet, which are the triangles. The weights that reconstruct tangential velocities are those of
// Thuburn, Ringler, Skamarock and Klemp, J. Comput. Phys. 228 (2009), equation (33). A second file lists the neighbours
// of each cell for METIS, which divides the mesh among the ranks of the model.
#include "comm/outbox.hpp"
#include "core/angle.hpp"
#include "dual/staggered.hpp"
#include "formats/cell_mesh.hpp"
#include "formats/netcdf_header.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace trime::formats {
namespace {

using dual::CellTriangle;
using dual::RingEdge;
using dual::Surroundings;
using geometry::Vec2;

constexpr std::int64_t most_int32 = std::numeric_limits<std::int32_t>::max();

/// The cells with the numbers of their staggered grid.
struct Grid {
  explicit Grid(const ExchangeMesh& mesh)
      : cells(std::make_shared<const CellMesh>(mesh)),
        staggered(cells->cells(), mesh.names().cells == CellKind::whole, mesh.comm()) {}

  const dual::Cells& sites() const { return cells->cells(); }

  std::shared_ptr<const CellMesh> cells;
  dual::StaggeredGrid staggered;
};

/// A site of this rank, and where to write.
struct Target {
  const Grid& grid;
  LocalIndex site;
  const Surroundings& around;
  std::string& text;
  NetcdfType id_type;

  /// Appends a number that counts from 0, or -1; MPAS counts from 1.
  void id(GlobalId number) const {
    if (id_type == NetcdfType::int64)
      append_big(text, std::int64_t{number + 1});
    else
      append_big(text, static_cast<std::int32_t>(number + 1));
  }
  void real(double number) const { append_big(text, number); }
  void integer(std::int64_t number) const { append_big(text, static_cast<std::int32_t>(number)); }
};

/// CDF-2 as long as all arrays fit.
NetcdfFormat mpas_format(const dual::StaggeredGrid& grid) {
  constexpr std::int64_t most_bytes = (std::int64_t{1} << 32) - 4, bytes = 8;
  const std::int64_t largest = std::max({2 * grid.most_edges() * grid.edge_count(), 3 * grid.vertex_count()});
  return bytes * largest <= most_bytes ? NetcdfFormat::offset_64 : NetcdfFormat::data_64;
}

/// Collects the header and the arrays of a file.
class MpasFile {
public:
  enum Place : std::size_t { cell, edge, vertex };

  MpasFile(const std::shared_ptr<const Grid>& grid, const ExchangeMesh& mesh)
      : grid_(grid), mesh_(mesh), header_(mpas_format(grid->staggered)),
        id_type_(grid->staggered.edge_count() < most_int32 ? NetcdfType::int32 : NetcdfType::int64) {
    const Vec2 period = mesh.names().period;
    const bool is_periodic = period.x > 0 || period.y > 0;
    for (const auto& [name, value] : {std::pair{"on_a_sphere", "NO"},
                                      {"is_periodic", is_periodic ? "YES" : "NO"},
                                      {"mesh_spec", "1.0"},
                                      {"Conventions", "MPAS"},
                                      {"source", "trime_mpi"},
                                      {"file_id", "trime_mpi"},
                                      {"parent_id", ""},
                                      {"history", ""}})
      header_.attribute({name, std::string(value)});
    for (const auto& [name, value] : {std::pair{"sphere_radius", 0.0}, {"x_period", period.x}, {"y_period", period.y}})
      header_.attribute({name, value});
    const dual::StaggeredGrid& counts = grid->staggered;
    places_ = {header_.dimension("nCells", counts.cell_count()), header_.dimension("nEdges", counts.edge_count()),
               header_.dimension("nVertices", counts.vertex_count())};
    most_ = header_.dimension("maxEdges", counts.most_edges());
    twice_most_ = header_.dimension("maxEdges2", 2 * counts.most_edges());
    two_ = header_.dimension("TWO", 2);
    degree_ = header_.dimension("vertexDegree", 3);
    header_.dimension("Time", 0);
  }

  std::size_t most() const { return most_; }
  std::size_t twice_most() const { return twice_most_; }
  std::size_t two() const { return two_; }
  std::size_t degree() const { return degree_; }
  NetcdfType id_type() const { return id_type_; }

  /// Adds an array over cells, edges or vertices. Append is called for each site with a cell, for each of its edges
  /// with the spoke, or for each of its vertices with the triangle of the Surroundings.
  template <class Append>
  void add(const std::string& name, Place place, NetcdfType type, const std::vector<std::size_t>& columns,
           const Append& append) {
    std::vector<std::size_t> dimensions{places_[place]};
    dimensions.insert(dimensions.end(), columns.begin(), columns.end());
    header_.variable({name, type, dimensions});
    rows_.push_back(site_rows(grid_->cells, [grid = grid_, type = id_type_, place,
                                             append](LocalIndex site, const Surroundings& around, std::string& text) {
      const Target to{*grid, site, around, text, type};
      if (!grid->staggered.is_cell(site))
        return;
      if (place == cell)
        append(to, std::size_t{0});
      for (std::size_t k = 0; place == edge && k < around.arms.size(); ++k)
        if (grid->staggered.owns_edge(site, around.ends[k]))
          append(to, k);
      for (std::size_t k = 0; place == vertex && k < around.triangles.size(); ++k)
        if (grid->staggered.owns_vertex(site, around.triangles[k]))
          append(to, k);
    }));
    pad();
  }

  template <class Value>
  void real(const std::string& name, Place place, const Value& value) {
    add(name, place, NetcdfType::float64, {}, [value](const Target& to, std::size_t k) { to.real(value(to, k)); });
  }

  /// Adds an array of zeros.
  void zeros(const std::string& name, Place place) {
    header_.variable({name, NetcdfType::float64, {places_[place]}});
    rows_.push_back({grid_->sites().site_count, [grid = grid_, place](std::int64_t row, std::string& text) {
                       const auto site = static_cast<LocalIndex>(row);
                       const dual::StaggeredGrid& counts = grid->staggered;
                       const std::int64_t count = place == cell   ? (counts.is_cell(site) ? 1 : 0)
                                                  : place == edge ? counts.edges_of(site)
                                                                  : counts.vertices_of(site);
                       text.append(static_cast<std::size_t>(count) * sizeof(double), '\0');
                     }});
    pad();
  }

  std::vector<io::TextRows> rows() const {
    std::vector<io::TextRows> rows{mesh_.once(header_.bytes())};
    rows.insert(rows.end(), rows_.begin(), rows_.end());
    return rows;
  }

private:
  void pad() {
    if (const std::size_t zeros = header_.padding(); zeros > 0)
      rows_.push_back(mesh_.once(std::string(zeros, '\0')));
  }

  std::shared_ptr<const Grid> grid_;
  const ExchangeMesh& mesh_;
  NetcdfHeader header_;
  NetcdfType id_type_;
  std::vector<io::TextRows> rows_;
  std::array<std::size_t, 3> places_{};                          // dimensions
  std::size_t most_ = 0, twice_most_ = 0, two_ = 0, degree_ = 0; // dimensions
};

using Place = MpasFile::Place;

/// Adds places: x and y as value(target, k) returns them; z, longitude and latitude are 0.
template <class Value>
void add_places(MpasFile& file, const std::string& what, Place place, const Value& value) {
  file.zeros("lat" + what, place);
  file.zeros("lon" + what, place);
  file.real("x" + what, place, [value](const Target& to, std::size_t k) { return value(to, k).x; });
  file.real("y" + what, place, [value](const Target& to, std::size_t k) { return value(to, k).y; });
  file.zeros("z" + what, place);
}

Vec2 site_of(const Target& to) {
  return to.grid.sites().points[at(to.site)];
}

void add_all_places(MpasFile& file) {
  add_places(file, "Cell", Place::cell, [](const Target& to, std::size_t) { return site_of(to); });
  add_places(file, "Edge", Place::edge,
             [](const Target& to, std::size_t spoke) { return site_of(to) + to.around.middle(spoke); });
  add_places(file, "Vertex", Place::vertex,
             [](const Target& to, std::size_t k) { return site_of(to) + to.around.centres[k]; });
}

void add_numbers(MpasFile& file) {
  file.add("indexToCellID", Place::cell, file.id_type(), {},
           [](const Target& to, std::size_t) { to.id(to.grid.staggered.cell_at(to.site)); });
  file.add("indexToEdgeID", Place::edge, file.id_type(), {},
           [](const Target& to, std::size_t spoke) { to.id(to.grid.staggered.edge_of_spoke(to.site, spoke)); });
  file.add("indexToVertexID", Place::vertex, file.id_type(), {},
           [](const Target& to, std::size_t k) { to.id(to.grid.staggered.vertex_at(to.around.triangles[k])); });
}

/// Adds a list around each cell: value(target, spoke) for each spoke, and none behind the last one.
template <class Value>
void add_around_cells(MpasFile& file, const std::string& name, const Value& value) {
  file.add(name, Place::cell, file.id_type(), {file.most()}, [value](const Target& to, std::size_t) {
    for (std::int64_t spoke = 0; spoke < to.grid.staggered.most_edges(); ++spoke)
      to.id(spoke < std::ssize(to.around.arms) ? value(to, static_cast<std::size_t>(spoke)) : -1);
  });
}

/// Neighbours, edges and vertices around each cell in one phase: vertex i is the far end of edge i.
void add_cell_lists(MpasFile& file) {
  file.add("nEdgesOnCell", Place::cell, NetcdfType::int32, {},
           [](const Target& to, std::size_t) { to.integer(std::ssize(to.around.arms)); });
  add_around_cells(file, "edgesOnCell",
                   [](const Target& to, std::size_t spoke) { return to.grid.staggered.edge_of_spoke(to.site, spoke); });
  add_around_cells(file, "cellsOnCell", [](const Target& to, std::size_t spoke) {
    return to.grid.staggered.cell_at(to.around.ends[spoke]);
  });
  add_around_cells(file, "verticesOnCell", [](const Target& to, std::size_t spoke) {
    const auto left = to.around.left(spoke);
    return left ? to.grid.staggered.vertex_at(to.around.triangles[*left]) : -1;
  });
}

/// The vertex on the right of an edge and that on its left, as the normal points from the first cell to the second.
void add_edge_lists(MpasFile& file) {
  file.add("cellsOnEdge", Place::edge, file.id_type(), {file.two()}, [](const Target& to, std::size_t spoke) {
    to.id(to.grid.staggered.cell_at(to.site));
    to.id(to.grid.staggered.cell_at(to.around.ends[spoke]));
  });
  file.add("verticesOnEdge", Place::edge, file.id_type(), {file.two()}, [](const Target& to, std::size_t spoke) {
    for (const auto& triangle : {to.around.right(spoke), to.around.left(spoke)})
      to.id(triangle ? to.grid.staggered.vertex_at(to.around.triangles[*triangle]) : -1);
  });
}

const CellTriangle& triangle_of(const Target& to, std::size_t k) {
  return to.grid.sites().triangles[at(to.around.triangles[k])];
}

/// Calls use(corner) for each cell around a vertex, counter-clockwise. Edge j lies before cell j.
void add_vertex_lists(MpasFile& file) {
  file.add("cellsOnVertex", Place::vertex, file.id_type(), {file.degree()}, [](const Target& to, std::size_t k) {
    for (const LocalIndex corner : triangle_of(to, k).corners)
      to.id(to.grid.staggered.cell_at(corner));
  });
  file.add("edgesOnVertex", Place::vertex, file.id_type(), {file.degree()}, [](const Target& to, std::size_t k) {
    for (std::size_t j = 0; j < 3; ++j)
      to.id(to.grid.staggered.edge_at(to.around.triangles[k], (j + 2) % 3));
  });
}

/// Calls use(k, before) for the other edges of a ring, counter-clockwise from an edge on: the index of each in the
/// ring, and that of the edge before it.
template <class Numbers, class Use>
void for_each_other(const Numbers& ring, GlobalId edge, const Use& use) {
  std::size_t here = 0;
  while (ring[here] != edge)
    ++here;
  for (std::size_t step = 1; step < ring.size(); ++step)
    use((here + step) % ring.size(), (here + step - 1) % ring.size());
}

/// The cells of an edge: that of the site, and that of the other end if it has one.
std::vector<LocalIndex> cells_of_edge(const Target& to, std::size_t spoke) {
  const LocalIndex end = to.around.ends[spoke];
  return to.grid.staggered.is_cell(end) ? std::vector{to.site, end} : std::vector{to.site};
}

/// The edges from which the tangential velocity at an edge is reconstructed: around the first cell from the edge on,
/// then around the second cell.
std::vector<GlobalId> edges_on_edge(const Target& to, std::size_t spoke) {
  const dual::StaggeredGrid& grid = to.grid.staggered;
  std::vector<GlobalId> edges;
  for (const LocalIndex cell : cells_of_edge(to, spoke)) {
    const std::vector<GlobalId> ring = grid.ring_numbers(cell);
    for_each_other(ring, grid.edge_of_spoke(to.site, spoke),
                   [&](std::size_t k, std::size_t) { edges.push_back(ring[k]); });
  }
  return edges;
}

/// The weights of these edges.
std::vector<double> weights_of(const Target& to, std::size_t spoke) {
  const dual::StaggeredGrid& grid = to.grid.staggered;
  double sign_over_length = 1 / length(to.around.arms[spoke]);
  std::vector<double> weights;
  for (const LocalIndex cell : cells_of_edge(to, spoke)) {
    const std::vector<RingEdge> ring = grid.ring(cell);
    double share = 0; // of the cell between the edge and the next one
    for_each_other(grid.ring_numbers(cell), grid.edge_of_spoke(to.site, spoke), [&](std::size_t k, std::size_t before) {
      share += ring[before].kite_share;
      weights.push_back((ring[k].is_first ? 1 : -1) * sign_over_length * (0.5 - share) * ring[k].dual_length);
    });
    sign_over_length = -sign_over_length;
  }
  return weights;
}

void add_reconstruction(MpasFile& file) {
  file.add("nEdgesOnEdge", Place::edge, NetcdfType::int32, {},
           [](const Target& to, std::size_t spoke) { to.integer(std::ssize(edges_on_edge(to, spoke))); });
  file.add("edgesOnEdge", Place::edge, file.id_type(), {file.twice_most()}, [](const Target& to, std::size_t spoke) {
    std::vector<GlobalId> edges = edges_on_edge(to, spoke);
    edges.resize(2 * static_cast<std::size_t>(to.grid.staggered.most_edges()), -1);
    for (const GlobalId edge : edges)
      to.id(edge);
  });
  file.add("weightsOnEdge", Place::edge, NetcdfType::float64, {file.twice_most()},
           [](const Target& to, std::size_t spoke) {
             std::vector<double> weights = weights_of(to, spoke);
             weights.resize(2 * static_cast<std::size_t>(to.grid.staggered.most_edges()), 0);
             for (const double weight : weights)
               to.real(weight);
           });
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum;
}

/// The kites of a triangle in cells; 0 where a cell is missing.
std::array<double, 3> kites_at(const Target& to, std::size_t k) {
  const CellTriangle& triangle = triangle_of(to, k);
  const dual::Cells& cells = to.grid.sites();
  const auto side = [&](std::size_t j) {
    return dual::difference(cells.points[at(triangle.corners[j])], cells.points[at(triangle.corners[0])], cells.period);
  };
  std::array<double, 3> kites = dual::kites_of(side(1), side(2));
  for (std::size_t j = 0; j < 3; ++j)
    if (!to.grid.staggered.is_cell(triangle.corners[j]))
      kites[j] = 0;
  return kites;
}

void add_measures(MpasFile& file) {
  file.real("dcEdge", Place::edge, [](const Target& to, std::size_t spoke) { return length(to.around.arms[spoke]); });
  file.real("dvEdge", Place::edge,
            [](const Target& to, std::size_t spoke) { return dual::face_of(to.around, spoke).dual_length(); });
  file.real("angleEdge", Place::edge, [](const Target& to, std::size_t spoke) {
    return angle_of(to.around.arms[spoke].y, to.around.arms[spoke].x);
  });
  file.real("areaCell", Place::cell,
            [](const Target& to, std::size_t) { return sum_of(dual::kites_around(to.around)); });
  file.real("areaTriangle", Place::vertex, [](const Target& to, std::size_t k) {
    const std::array<double, 3> kites = kites_at(to, k);
    return kites[0] + kites[1] + kites[2];
  });
  file.add("kiteAreasOnVertex", Place::vertex, NetcdfType::float64, {file.degree()},
           [](const Target& to, std::size_t k) {
             for (const double kite : kites_at(to, k))
               to.real(kite);
           });
  file.add("boundaryVertex", Place::vertex, NetcdfType::int32, {}, [](const Target& to, std::size_t k) {
    const auto& corners = triangle_of(to, k).corners;
    to.integer(std::all_of(corners.begin(), corners.end(), [&](LocalIndex c) { return to.grid.staggered.is_cell(c); })
                   ? 0
                   : 1);
  });
}

/// Sides and angles of a triangle, ascending.
struct TriangleShape {
  std::array<double, 3> sides, angles;
};
TriangleShape shape_at(const Target& to, std::size_t k) {
  const Vec2 b = to.around.arms[k], c = to.around.arms[to.around.spoke_behind(k, 1)], side = c - b;
  const auto angle = [](Vec2 from, Vec2 towards) { return angle_of(cross(from, towards), dot(from, towards)); };
  TriangleShape shape{{length(b), length(c), length(side)},
                      {angle(b, c), angle(side, Vec2{0, 0} - b), angle(Vec2{0, 0} - c, Vec2{0, 0} - side)}};
  std::sort(shape.sides.begin(), shape.sides.end());
  std::sort(shape.angles.begin(), shape.angles.end());
  return shape;
}

void add_qualities(MpasFile& file) {
  file.real("cellQuality", Place::cell, [](const Target& to, std::size_t) {
    double shortest = std::numeric_limits<double>::max(), longest = 0;
    for (std::size_t spoke = 0; spoke < to.around.arms.size(); ++spoke) {
      const double side = dual::face_of(to.around, spoke).dual_length();
      shortest = std::min(shortest, side);
      longest = std::max(longest, side);
    }
    return shortest / longest;
  });
  file.real("gridSpacing", Place::cell, [](const Target& to, std::size_t) {
    double sum = 0;
    for (const Vec2 arm : to.around.arms)
      sum += length(arm);
    return sum / static_cast<double>(to.around.arms.size());
  });
  file.real("triangleQuality", Place::vertex, [](const Target& to, std::size_t k) {
    const TriangleShape shape = shape_at(to, k);
    return shape.sides[0] / shape.sides[2];
  });
  file.real("triangleAngleQuality", Place::vertex, [](const Target& to, std::size_t k) {
    const TriangleShape shape = shape_at(to, k);
    return shape.angles[0] / shape.angles[2];
  });
  file.add("obtuseTriangle", Place::vertex, NetcdfType::int32, {},
           [](const Target& to, std::size_t k) { to.integer(shape_at(to, k).angles[2] > 90 * degrees ? 1 : 0); });
}

/// The size h of a point on its way to the rank whose site it is.
struct SentSize {
  GlobalId point;
  double size;
};

/// Adds the density (least h / h)^4, as is custom for MPAS.
void add_density(MpasFile& file, const Grid& grid, const ExchangeMesh& mesh) {
  const mesh::DistributedMesh& part = mesh.mesh();
  double least = std::numeric_limits<double>::max();
  comm::Outbox<SentSize> away;
  for (std::size_t k = 0; k < part.points.size(); ++k) {
    const GlobalId point = part.point_slab.first + static_cast<GlobalId>(k);
    away[grid.sites().shares.rank_of(point)].push_back({point, part.size[k]});
    least = std::min(least, double{part.size[k]});
  }
  const auto sizes = std::make_shared<std::vector<double>>(at(grid.sites().site_count));
  for (const comm::Message& message : comm::send(mesh.comm(), away))
    for (const SentSize& sent : comm::from_bytes<SentSize>(message.data))
      (*sizes)[static_cast<std::size_t>(sent.point - grid.sites().first_site)] = sent.size;
  least = mesh.comm().min(least);
  file.real("meshDensity", Place::cell, [sizes, least](const Target& to, std::size_t) {
    const double ratio = least / (*sizes)[at(to.site)];
    return ratio * ratio * ratio * ratio;
  });
}

/// The graph of the cells for METIS: the neighbours of each cell in a line.
FilePlan graph_file(const std::shared_ptr<const Grid>& grid, const ExchangeMesh& mesh, const std::string& path) {
  const std::string head = fmt::format("{} {}\n", grid->staggered.cell_count(), grid->staggered.inner_edge_count());
  return {
      path,
      {mesh.once(head), site_rows(grid->cells, [grid](LocalIndex site, const Surroundings& around, std::string& to) {
         if (!grid->staggered.is_cell(site))
           return;
         for (const LocalIndex end : around.ends)
           if (grid->staggered.is_cell(end)) {
             io::append_number(to, grid->staggered.cell_at(end) + 1);
             to += ' ';
           }
         to += '\n';
       })}};
}

} // namespace

std::vector<FilePlan> plan_mpas(const ExchangeMesh& mesh, const std::string& path) {
  const auto grid = std::make_shared<const Grid>(mesh);
  const dual::StaggeredGrid& counts = grid->staggered;
  if (counts.cell_count() == 0) // all ranks find the same
    throw FileError("no point of the mesh lies inside, so there is no whole Voronoi cell; use more points, or "
                    "'cells = voronoi' in [output]");
  MpasFile file(grid, mesh);
  add_all_places(file);
  add_numbers(file);
  add_cell_lists(file);
  add_edge_lists(file);
  add_vertex_lists(file);
  add_reconstruction(file);
  add_measures(file);
  add_density(file, *grid, mesh);
  add_qualities(file);
  FilePlan plan = grid->cells->proved({path, file.rows()});
  if (counts.cell_count() < mesh.points())
    plan.summary += fmt::format("; {} of them are whole and in the file", counts.cell_count());
  return {plan, graph_file(grid, mesh, paths_of(Format::mpas, path, mesh.names())[1])};
}

} // namespace trime::formats
