// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML unstructured grid (VTK file formats, "Unstructured Grid"), arrays appended as raw binary with 64-bit sizes.
// Cells are the triangles, then the labelled edges; `label` is 0 on triangles, `region` 0 on edges. Field
// data give the number of each name.
#include "formats/vtu_arrays.hpp"

namespace trime::formats {
namespace {

constexpr std::uint8_t vtk_line = 3, vtk_triangle = 5;

/// A value for each triangle, then one for each edge.
template <class T, class OfTriangle, class OfFacet>
void add_of_cells(const ExchangeMesh& mesh, VtuArrays& data, const OfTriangle& of_triangle, const OfFacet& of_facet) {
  data.add((mesh.triangles() + mesh.lines()) * static_cast<GlobalId>(sizeof(T)),
           {mesh.triangle_rows([of_triangle](std::int64_t row, GlobalId id, const auto&, std::string& to) {
              append_bytes(to, static_cast<T>(of_triangle(row, id)));
            }),
            mesh.line_rows([of_facet](std::int64_t row, GlobalId id, const auto&, std::string& to) {
              append_bytes(to, static_cast<T>(of_facet(row, id)));
            })});
}

void add_points(const ExchangeMesh& mesh, std::string& xml, VtuArrays& data) {
  xml += "<Points>\n" + data.describe("Float64", "Points", 3) + "</Points>\n";
  data.add(mesh.points() * 24, {mesh.point_rows([](std::int64_t, GlobalId, geometry::Vec2 p, std::string& to) {
             for (const double coordinate : {p.x, p.y, 0.0})
               append_bytes(to, coordinate);
           })});
}

void add_cells(const ExchangeMesh& mesh, std::string& xml, VtuArrays& data) {
  const auto append_ids = [](std::int64_t, GlobalId, const auto& ids, std::string& to) {
    for (const GlobalId id : ids)
      append_bytes(to, id);
  };
  const GlobalId triangles = mesh.triangles();
  xml += "<Cells>\n" + data.describe("Int64", "connectivity", 1);
  data.add(8 * (3 * triangles + 2 * mesh.lines()), {mesh.triangle_rows(append_ids), mesh.line_rows(append_ids)});
  xml += data.describe("Int64", "offsets", 1);
  add_of_cells<std::int64_t>(
      mesh, data, [](std::int64_t, GlobalId id) { return 3 * (id + 1); },
      [triangles](std::int64_t, GlobalId id) { return 3 * triangles + 2 * (id + 1); });
  xml += data.describe("UInt8", "types", 1);
  add_of_cells<std::uint8_t>(
      mesh, data, [](std::int64_t, GlobalId) { return vtk_triangle; }, [](std::int64_t, GlobalId) { return vtk_line; });
  xml += "</Cells>\n";
}

void add_fields(const ExchangeMesh& mesh, std::string& xml, VtuArrays& data) {
  const auto nothing = [](std::int64_t, GlobalId) { return 0; };
  xml += "<PointData>\n" + data.describe("Int32", "label", 1);
  data.add(4 * mesh.points(), {mesh.point_rows([&mesh](std::int64_t row, GlobalId, geometry::Vec2, std::string& to) {
             append_bytes(to, static_cast<std::int32_t>(mesh.point_label(row)));
           })});
  xml += "</PointData>\n<CellData>\n" + data.describe("Int32", "label", 1);
  add_of_cells<std::int32_t>(mesh, data, nothing, [&mesh](std::int64_t row, GlobalId) { return mesh.line_label(row); });
  xml += data.describe("Int32", "region", 1);
  add_of_cells<std::int32_t>(
      mesh, data, [&mesh](std::int64_t row, GlobalId) { return mesh.region(row); }, nothing);
  xml += "</CellData>\n";
}

} // namespace

std::vector<FilePlan> plan_vtu(const ExchangeMesh& mesh, const std::string& path) {
  VtuArrays data(mesh);
  std::string xml =
      vtu_head(vtu_numbers_by_name("label", mesh.line_names()) + vtu_numbers_by_name("region", mesh.names().regions),
               mesh.points(), mesh.triangles() + mesh.lines());
  add_points(mesh, xml, data);
  add_cells(mesh, xml, data);
  add_fields(mesh, xml, data);
  return {vtu_file(mesh, path, xml, data)};
}

} // namespace trime::formats
