// SPDX-License-Identifier: BSD-3-Clause
// MSH 4.1 and 2.2 of Gmsh (reference manual, "MSH file format" and "Legacy formats"), binary: boundary parts, curves,
// interfaces and regions are physical groups. Each part is a curve and each region a surface, since all elements of one
// entity lie in the same groups.
#include "formats/exchange_mesh.hpp"

#include <algorithm>
#include <initializer_list>

#include <fmt/format.h>

namespace trime::formats {
namespace {

constexpr std::int32_t line_type = 1, triangle_type = 2; // of elements
constexpr int curve = 1, surface = 2;                    // dimensions of entities

/// Names end at a quotation mark.
std::string quoted(std::string name) {
  std::replace(name.begin(), name.end(), '"', '\'');
  return '"' + name + '"';
}

/// @brief Names of edges that have edges, ascending. The others are not curves of the file: meshio and dolfinx
/// do not read an entity without elements.
std::vector<std::size_t> parts_with_edges(const ExchangeMesh& mesh) {
  std::vector<std::size_t> parts;
  for (std::size_t part = 0; part < mesh.line_names().size(); ++part)
    if (mesh.lines_of(part) > 0)
      parts.push_back(part);
  return parts;
}

/// @brief Regions that have triangles, ascending, as indices into Names::regions. @pre the mesh has a triangle
std::vector<std::size_t> regions_with_triangles(const ExchangeMesh& mesh) {
  std::vector<std::size_t> regions;
  for (std::size_t region = 0; region < mesh.names().regions.size(); ++region)
    if (mesh.triangles_of_region(region) > 0)
      regions.push_back(region);
  return regions;
}

/// meshio knows a group by its name alone: a region that is called like a part of the boundary gets "region" in front.
std::string surface_name(std::string name, const ExchangeMesh& mesh, const std::vector<std::size_t>& parts) {
  const auto is_taken = [&](std::size_t part) { return mesh.line_names()[part] == name; };
  while (std::any_of(parts.begin(), parts.end(), is_taken))
    name = "region " + name;
  return name;
}

std::string physical_names(const ExchangeMesh& mesh) {
  const Names& names = mesh.names();
  const std::vector<std::size_t> parts = parts_with_edges(mesh), regions = regions_with_triangles(mesh);
  std::string text = fmt::format("$PhysicalNames\n{}\n", parts.size() + regions.size());
  for (const std::size_t k : parts)
    text += fmt::format("{} {} {}\n", curve, k + 1, quoted(mesh.line_names()[k]));
  for (const std::size_t k : regions)
    text += fmt::format("{} {} {}\n", surface, k + 1, quoted(surface_name(names.regions[k], mesh, parts)));
  return text + "$EndPhysicalNames\n";
}

/// With the number 1 as this machine stores it.
std::string header(const char* version) {
  std::string text = fmt::format("$MeshFormat\n{} 1 8\n", version);
  append_bytes(text, std::int32_t{1});
  return text + "\n$EndMeshFormat\n";
}

/// One entity of 4.1 with one physical group of the same number. Its box is that of the whole mesh.
void append_entity(std::string& text, const ExchangeMesh& mesh, std::size_t number, std::size_t bounding) {
  const auto tag = static_cast<std::int32_t>(number);
  append_bytes(text, tag);
  for (const double side : {mesh.lower().x, mesh.lower().y, 0.0, mesh.upper().x, mesh.upper().y, 0.0})
    append_bytes(text, side);
  append_bytes(text, std::uint64_t{1});
  append_bytes(text, tag);
  append_bytes(text, static_cast<std::uint64_t>(bounding));
}

std::string entities(const ExchangeMesh& mesh) {
  const std::vector<std::size_t> parts = parts_with_edges(mesh);
  const std::vector<std::size_t> regions = regions_with_triangles(mesh);
  std::string text = "$Entities\n";
  for (const std::size_t count : {std::size_t{0}, parts.size(), regions.size(), std::size_t{0}})
    append_bytes(text, static_cast<std::uint64_t>(count));
  for (const std::size_t part : parts)
    append_entity(text, mesh, part + 1, 0);
  for (const std::size_t region : regions) {
    append_entity(text, mesh, region + 1, parts.size());
    for (const std::size_t part : parts)
      append_bytes(text, static_cast<std::int32_t>(part + 1));
  }
  return text + "\n$EndEntities\n";
}

/// Numbers that begin a section, or a block in it.
void append_counts(std::string& text, std::initializer_list<std::int64_t> counts) {
  for (const std::int64_t count : counts)
    append_bytes(text, count);
}
std::string block(int dimension, std::size_t entity, std::int32_t type, GlobalId count) {
  std::string text;
  append_bytes(text, static_cast<std::int32_t>(dimension));
  append_bytes(text, static_cast<std::int32_t>(entity));
  append_bytes(text, type);
  append_bytes(text, count);
  return text;
}

void append_place(std::string& text, geometry::Vec2 p) {
  for (const double coordinate : {p.x, p.y, 0.0})
    append_bytes(text, coordinate);
}

/// All points are said to lie inside the first surface: readers go by the elements.
void add_nodes(const ExchangeMesh& mesh, std::vector<io::TextRows>& rows) {
  const GlobalId points = mesh.points();
  std::string text = "$Nodes\n";
  append_counts(text, {1, points, 1, points});
  const std::vector<std::size_t> regions = regions_with_triangles(mesh);
  rows.push_back(mesh.once(text + block(surface, regions.empty() ? 1 : regions[0] + 1, 0, points)));
  rows.push_back(
      mesh.point_rows([](std::int64_t, GlobalId id, geometry::Vec2, std::string& to) { append_bytes(to, id + 1); }));
  rows.push_back(
      mesh.point_rows([](std::int64_t, GlobalId, geometry::Vec2 p, std::string& to) { append_place(to, p); }));
  rows.push_back(mesh.once("\n$EndNodes\n"));
}

/// Edges come first and keep their numbers in the mesh; so do the triangles after them.
void add_elements(const ExchangeMesh& mesh, std::vector<io::TextRows>& rows) {
  const GlobalId facets = mesh.lines(), elements = facets + mesh.triangles();
  const std::vector<std::size_t> parts = parts_with_edges(mesh);
  const std::vector<std::size_t> regions = regions_with_triangles(mesh);
  std::string text = "$Elements\n";
  append_counts(text, {static_cast<std::int64_t>(parts.size() + regions.size()), elements, 1, elements});
  rows.push_back(mesh.once(text));
  for (const std::size_t part : parts) {
    rows.push_back(mesh.once(block(curve, part + 1, line_type, mesh.lines_of(part))));
    const auto label = static_cast<std::int64_t>(part) + 1;
    rows.push_back(mesh.line_rows(
        [&mesh, label](std::int64_t row, GlobalId id, const std::array<GlobalId, 2>& ends, std::string& to) {
          if (mesh.line_label(row) == label)
            append_counts(to, {id + 1, ends[0] + 1, ends[1] + 1});
        }));
  }
  for (const std::size_t region : regions) {
    rows.push_back(mesh.once(block(surface, region + 1, triangle_type, mesh.triangles_of_region(region))));
    const auto number = static_cast<std::int64_t>(region) + 1;
    rows.push_back(mesh.triangle_rows([&mesh, facets, number](std::int64_t row, GlobalId id,
                                                              const std::array<GlobalId, 3>& corners, std::string& to) {
      if (mesh.region(row) == number)
        append_counts(to, {facets + id + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1});
    }));
  }
  rows.push_back(mesh.once("\n$EndElements\n"));
}

void append_numbers(std::string& text, std::initializer_list<std::int64_t> numbers) {
  for (const std::int64_t number : numbers)
    append_bytes(text, static_cast<std::int32_t>(number));
}

} // namespace

std::vector<FilePlan> plan_gmsh(const ExchangeMesh& mesh, const std::string& path) {
  std::vector<io::TextRows> rows{mesh.once(header("4.1") + physical_names(mesh) + entities(mesh))};
  add_nodes(mesh, rows);
  add_elements(mesh, rows);
  return {{path, rows}};
}

std::vector<FilePlan> plan_gmsh2(const ExchangeMesh& mesh, const std::string& path) {
  constexpr std::int64_t tags = 2; // physical, elementary
  const GlobalId facets = mesh.lines();
  std::string lines = fmt::format("\n$EndNodes\n$Elements\n{}\n", facets + mesh.triangles()), triangles;
  append_numbers(lines, {line_type, facets, tags});
  append_numbers(triangles, {triangle_type, mesh.triangles(), tags});
  return {
      {path,
       {mesh.once(header("2.2") + physical_names(mesh) + fmt::format("$Nodes\n{}\n", mesh.points())),
        mesh.point_rows([](std::int64_t, GlobalId id, geometry::Vec2 p, std::string& to) {
          append_numbers(to, {id + 1});
          append_place(to, p);
        }),
        mesh.once(lines),
        mesh.line_rows([&mesh](std::int64_t row, GlobalId id, const std::array<GlobalId, 2>& ends, std::string& to) {
          append_numbers(to, {id + 1, mesh.line_label(row), mesh.line_label(row), ends[0] + 1, ends[1] + 1});
        }),
        mesh.once(triangles),
        mesh.triangle_rows(
            [&mesh, facets](std::int64_t row, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
              append_numbers(to, {facets + id + 1, mesh.region(row), mesh.region(row), corners[0] + 1, corners[1] + 1,
                                  corners[2] + 1});
            }),
        mesh.once("\n$EndElements\n")}}};
}

} // namespace trime::formats
