// SPDX-License-Identifier: BSD-3-Clause
// MSH 4.1 and 2.2 of Gmsh (reference manual, "MSH file format" and "Legacy formats"), binary: boundary parts, curves,
// interfaces and regions are physical groups. Each part is a curve and each region a surface, since all elements of one
// entity lie in the same groups.
#include "comm/agree.hpp"
#include "formats/exchange_mesh.hpp"
#include "formats/rows_by_number.hpp"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <memory>
#include <set>

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

std::string physical_names(const ExchangeMesh& mesh) {
  const std::vector<std::size_t> parts = parts_with_edges(mesh), regions = regions_with_triangles(mesh);
  std::string text = fmt::format("$PhysicalNames\n{}\n", parts.size() + regions.size());
  std::set<std::string> taken;
  for (const std::size_t k : parts) {
    text += fmt::format("{} {} {}\n", curve, k + 1, quoted(mesh.line_names()[k]));
    taken.insert(mesh.line_names()[k]);
  }
  for (const std::size_t k : regions) {
    std::string name = mesh.names().regions[k];
    while (taken.contains(name)) // meshio knows a group by its name alone
      name = "region " + name;
    text += fmt::format("{} {} {}\n", surface, k + 1, quoted(name));
  }
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

/// @brief Returns for each region the names of edges on its border: all parts and curves, and its own interfaces. A
/// mesh of many grains would be huge if every surface listed all interfaces. Collective.
std::vector<std::vector<std::size_t>> names_around(const ExchangeMesh& mesh) {
  struct Sides {
    std::int32_t pair;
    std::array<std::int32_t, 2> regions;
    auto operator<=>(const Sides&) const = default;
  };
  std::set<Sides> here;
  for (std::size_t k = 0; k < mesh.mesh().interfaces.size(); ++k)
    here.insert({mesh.mesh().interface_pairs[k], mesh.mesh().interface_regions[k]});
  const std::vector<Sides> all = comm::gather_everywhere(mesh.comm(), std::vector<Sides>(here.begin(), here.end()));
  const std::size_t before = mesh.names().parts.size() + mesh.names().curves.size();
  std::vector<std::vector<std::size_t>> names(mesh.names().regions.size());
  for (std::vector<std::size_t>& of_region : names)
    for (std::size_t name = 0; name < before; ++name)
      if (mesh.lines_of(name) > 0)
        of_region.push_back(name);
  for (const Sides& sides : std::set<Sides>(all.begin(), all.end()))
    if (const std::size_t name = before + static_cast<std::size_t>(sides.pair); mesh.lines_of(name) > 0)
      for (const std::int32_t region : sides.regions)
        names.at(static_cast<std::size_t>(region) - 1).push_back(name);
  return names;
}

std::string entities(const ExchangeMesh& mesh) {
  const std::vector<std::size_t> parts = parts_with_edges(mesh);
  const std::vector<std::size_t> regions = regions_with_triangles(mesh);
  const std::vector<std::vector<std::size_t>> around = names_around(mesh);
  std::string text = "$Entities\n";
  for (const std::size_t count : {std::size_t{0}, parts.size(), regions.size(), std::size_t{0}})
    append_bytes(text, static_cast<std::uint64_t>(count));
  for (const std::size_t part : parts)
    append_entity(text, mesh, part + 1, 0);
  for (const std::size_t region : regions) {
    append_entity(text, mesh, region + 1, around[region].size());
    for (const std::size_t name : around[region])
      append_bytes(text, static_cast<std::int32_t>(name + 1));
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

/// The elements of one type: a block for each name, which becomes an entity.
struct BlockSet {
  int dimension;
  std::int32_t type;
  std::vector<std::size_t> names; ///< those with elements, ascending
  io::TextRows elements;
  std::function<std::int64_t(std::int64_t row)> number; ///< of an element: that of its name, from 1
  std::function<GlobalId(std::size_t name)> count;      ///< over all ranks
};

void add_blocks(const ExchangeMesh& mesh, const BlockSet& set, std::vector<io::TextRows>& rows) {
  const auto by_number = std::make_shared<const RowsByNumber>( // rows outlive this function
      set.elements.rows, set.names.empty() ? 0 : set.names.back() + 1, set.number);
  for (const std::size_t name : set.names) {
    rows.push_back(mesh.once(block(set.dimension, name + 1, set.type, set.count(name))));
    rows.push_back(rows_of_number(by_number, name + 1, set.elements.append));
  }
}

/// Edges come first and keep their numbers in the mesh; so do the triangles after them.
void add_elements(const ExchangeMesh& mesh, std::vector<io::TextRows>& rows) {
  const GlobalId lines = mesh.lines(), elements = lines + mesh.triangles();
  const BlockSet edges{
      curve,
      line_type,
      parts_with_edges(mesh),
      mesh.line_rows([](std::int64_t, GlobalId id, const std::array<GlobalId, 2>& ends, std::string& to) {
        append_counts(to, {id + 1, ends[0] + 1, ends[1] + 1});
      }),
      [&mesh](std::int64_t row) { return mesh.line_label(row); },
      [&mesh](std::size_t name) { return mesh.lines_of(name); }};
  const BlockSet triangles{
      surface,
      triangle_type,
      regions_with_triangles(mesh),
      mesh.triangle_rows([lines](std::int64_t, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
        append_counts(to, {lines + id + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1});
      }),
      [&mesh](std::int64_t row) { return mesh.region(row); },
      [&mesh](std::size_t region) { return mesh.triangles_of_region(region); }};
  std::string text = "$Elements\n";
  append_counts(text, {static_cast<std::int64_t>(edges.names.size() + triangles.names.size()), elements, 1, elements});
  rows.push_back(mesh.once(text));
  add_blocks(mesh, edges, rows);
  add_blocks(mesh, triangles, rows);
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
