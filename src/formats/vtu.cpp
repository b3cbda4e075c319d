// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML unstructured grid (VTK file formats, "Unstructured Grid"), arrays appended as raw binary with 64-bit sizes.
// Cells are the triangles, then the labelled edges; `label` is 0 on triangles, `region` 0 on edges. Field
// data give the number of each name.
#include "formats/exchange_mesh.hpp"

#include <fmt/format.h>

#include <bit>

namespace trime::formats {
namespace {

constexpr std::uint8_t vtk_line = 3, vtk_triangle = 5;

/// The arrays, in the order in which their descriptions and their bytes stand.
class Appended {
public:
  explicit Appended(const ExchangeMesh& mesh) : mesh_(mesh) {}

  std::string describe(const char* type, const char* name, int components) const {
    const std::string columns = components > 1 ? fmt::format(" NumberOfComponents=\"{}\"", components) : "";
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type, name,
                       columns, offset_);
  }
  /// The bytes of an array: their number, then those of each set of rows.
  void add(GlobalId bytes, std::vector<io::TextRows> rows) {
    std::string size;
    append_bytes(size, static_cast<std::uint64_t>(bytes));
    rows_.push_back(mesh_.once(size));
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    offset_ += static_cast<GlobalId>(size.size()) + bytes;
  }
  /// A value for each triangle, then one for each edge.
  template <class T, class OfTriangle, class OfFacet>
  void add_cells(const OfTriangle& of_triangle, const OfFacet& of_facet) {
    add((mesh_.triangles() + mesh_.lines()) * static_cast<GlobalId>(sizeof(T)),
        {mesh_.triangle_rows([of_triangle](std::int64_t row, GlobalId id, const auto&, std::string& to) {
           append_bytes(to, static_cast<T>(of_triangle(row, id)));
         }),
         mesh_.line_rows([of_facet](std::int64_t row, GlobalId id, const auto&, std::string& to) {
           append_bytes(to, static_cast<T>(of_facet(row, id)));
         })});
  }
  const std::vector<io::TextRows>& rows() const { return rows_; }

private:
  const ExchangeMesh& mesh_;
  std::vector<io::TextRows> rows_;
  GlobalId offset_ = 0;
};

std::string in_xml(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return escaped;
}

/// One number for each name, called after it: readers other than VTK have no arrays of texts.
std::string numbers_by_name(const char* what, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text +=
        fmt::format("<DataArray type=\"Int32\" Name=\"{} {}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
                    what, in_xml(names[k]), k + 1);
  return text;
}

void add_points(const ExchangeMesh& mesh, std::string& xml, Appended& data) {
  xml += "<Points>\n" + data.describe("Float64", "Points", 3) + "</Points>\n";
  data.add(mesh.points() * 24, {mesh.point_rows([](std::int64_t, GlobalId, geometry::Vec2 p, std::string& to) {
             for (const double coordinate : {p.x, p.y, 0.0})
               append_bytes(to, coordinate);
           })});
}

void add_cells(const ExchangeMesh& mesh, std::string& xml, Appended& data) {
  const auto append_ids = [](std::int64_t, GlobalId, const auto& ids, std::string& to) {
    for (const GlobalId id : ids)
      append_bytes(to, id);
  };
  const GlobalId triangles = mesh.triangles();
  xml += "<Cells>\n" + data.describe("Int64", "connectivity", 1);
  data.add(8 * (3 * triangles + 2 * mesh.lines()), {mesh.triangle_rows(append_ids), mesh.line_rows(append_ids)});
  xml += data.describe("Int64", "offsets", 1);
  data.add_cells<std::int64_t>([](std::int64_t, GlobalId id) { return 3 * (id + 1); },
                               [triangles](std::int64_t, GlobalId id) { return 3 * triangles + 2 * (id + 1); });
  xml += data.describe("UInt8", "types", 1);
  data.add_cells<std::uint8_t>([](std::int64_t, GlobalId) { return vtk_triangle; },
                               [](std::int64_t, GlobalId) { return vtk_line; });
  xml += "</Cells>\n";
}

void add_fields(const ExchangeMesh& mesh, std::string& xml, Appended& data) {
  const auto nothing = [](std::int64_t, GlobalId) { return 0; };
  xml += "<PointData>\n" + data.describe("Int32", "label", 1);
  data.add(4 * mesh.points(), {mesh.point_rows([&mesh](std::int64_t row, GlobalId, geometry::Vec2, std::string& to) {
             append_bytes(to, static_cast<std::int32_t>(mesh.point_label(row)));
           })});
  xml += "</PointData>\n<CellData>\n" + data.describe("Int32", "label", 1);
  data.add_cells<std::int32_t>(nothing, [&mesh](std::int64_t row, GlobalId) { return mesh.line_label(row); });
  xml += data.describe("Int32", "region", 1);
  data.add_cells<std::int32_t>([&mesh](std::int64_t row, GlobalId) { return mesh.region(row); }, nothing);
  xml += "</CellData>\n";
}

} // namespace

std::vector<FilePlan> plan_vtu(const ExchangeMesh& mesh, const std::string& path) {
  Appended data(mesh);
  std::string xml =
      fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                  "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n{}{}</FieldData>\n"
                  "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                  std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
                  numbers_by_name("label", mesh.line_names()), numbers_by_name("region", mesh.names().regions),
                  mesh.points(), mesh.triangles() + mesh.lines());
  add_points(mesh, xml, data);
  add_cells(mesh, xml, data);
  add_fields(mesh, xml, data);
  xml += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  std::vector<io::TextRows> rows{mesh.once(xml)};
  rows.insert(rows.end(), data.rows().begin(), data.rows().end());
  rows.push_back(mesh.once("\n</AppendedData>\n</VTKFile>\n"));
  return {{path, rows}};
}

} // namespace trime::formats
