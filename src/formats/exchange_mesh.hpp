// SPDX-License-Identifier: BSD-3-Clause
// Gives a distributed mesh to the writers of formats of other programs: as rows of points, triangles and labelled
// edges.
#pragma once

#include "io/labelled_lines.hpp"
#include "io/text_rows.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/formats/exchange.hpp"

#include <array>
#include <string>
#include <vector>

namespace trime::formats {

/// The path of a file and its rows, which all ranks write together.
struct FilePlan {
  std::string path;
  std::vector<io::TextRows> rows;
  mesh::Checks checks{}; ///< what was checked about data beyond the mesh
  std::string summary{}; ///< a line about that
  std::string warning{}; ///< what a user should know of it before the file is used
};

/// Appends the bytes of a value as they are in memory.
template <class T>
void append_bytes(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}
/// Appends numbers with a blank between them, and a line end.
template <class... T>
void append_line(std::string& text, T... values) {
  ((io::append_number(text, values), text += ' '), ...);
  text.back() = '\n';
}

class ExchangeMesh {
public:
  /// Counts and labels the parts of the mesh. Collective.
  /// @pre all arguments outlive this object and the rows that it makes
  ExchangeMesh(const mesh::DistributedMesh& mesh, const Names& names, const comm::Communicator& comm);

  const mesh::DistributedMesh& mesh() const { return mesh_; }
  const Names& names() const { return names_; }
  const comm::Communicator& comm() const { return comm_; }
  GlobalId points() const { return mesh_.point_slab.total; }
  GlobalId triangles() const { return mesh_.triangle_slab.total; }
  /// Returns the number of edges with labels over all ranks: edges on the boundary, then edges on curves inside, then
  /// edges between regions. The order does not depend on the number of ranks.
  GlobalId lines() const { return lines_.slab.total; }
  std::int64_t rank_lines() const { return std::ssize(lines_.ends); } ///< on this rank
  /// Returns the names of these edges: label k + 1 has the name k. First the parts of the boundary, then the curves and
  /// the interfaces.
  const std::vector<std::string>& line_names() const { return line_names_; }
  /// Return the number of edges with a name, and of triangles of a region, over all ranks.
  GlobalId lines_of(std::size_t name) const { return lines_of_[name]; }
  GlobalId triangles_of_region(std::size_t region) const { return triangles_of_region_[region]; }
  geometry::Vec2 lower() const { return lower_; }
  geometry::Vec2 upper() const { return upper_; }

  /// Return the ends and the label of an edge, the region of a triangle, and the label of a point (0 inside); `row`
  /// counts on this rank.
  const std::array<GlobalId, 2>& line(std::int64_t row) const { return lines_.ends[static_cast<std::size_t>(row)]; }
  std::int64_t line_label(std::int64_t row) const { return lines_.labels[static_cast<std::size_t>(row)]; }
  std::int64_t region(std::int64_t row) const {
    return mesh_.region.empty() ? 1 : mesh_.region[static_cast<std::size_t>(row)];
  }
  std::int64_t point_label(std::int64_t row) const { return point_labels_[static_cast<std::size_t>(row)]; }

  /// Returns rows with a text that occurs once in the file, however many ranks there are.
  io::TextRows once(std::string text) const;
  /// Return rows for which append(row, global number, value, text) is called, once for each row of this rank.
  template <class Append>
  io::TextRows point_rows(const Append& append) const {
    return {std::ssize(mesh_.points), [this, append](std::int64_t row, std::string& text) {
              append(row, mesh_.point_slab.first + row, mesh_.points[static_cast<std::size_t>(row)], text);
            }};
  }
  template <class Append>
  io::TextRows triangle_rows(const Append& append) const {
    return {std::ssize(mesh_.triangles), [this, append](std::int64_t row, std::string& text) {
              append(row, mesh_.triangle_slab.first + row, mesh_.triangle_ids(static_cast<std::size_t>(row)), text);
            }};
  }
  template <class Append>
  io::TextRows line_rows(const Append& append) const {
    return {rank_lines(), [this, append](std::int64_t row, std::string& text) {
              append(row, lines_.slab.first + row, line(row), text);
            }};
  }

private:
  void check_numbers() const;
  void count();
  void label_points();

  const mesh::DistributedMesh& mesh_;
  const Names& names_;
  const comm::Communicator& comm_;
  io::LabelledLines lines_;
  std::vector<std::string> line_names_;
  std::vector<std::int64_t> lines_of_, triangles_of_region_;
  std::vector<std::int32_t> point_labels_; // label of each point of the slab
  geometry::Vec2 lower_, upper_;
};

// The writers of the formats. Each returns the plan of its files; `path` is that of the first file. Collective.
std::vector<FilePlan> plan_gmsh(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_gmsh2(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_medit(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_freefem(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_triangle(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_voronoi(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_disv(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_uge(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_mpas(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_tough(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_vtu(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_sms(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_adcirc(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_schism(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_su2(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_telemac(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_fvcom(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_geojson(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_abaqus(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_exodus(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_ugrid(const ExchangeMesh& mesh, const std::string& path);
std::vector<FilePlan> plan_ugrid_cells(const ExchangeMesh& mesh, const std::string& path);

} // namespace trime::formats
