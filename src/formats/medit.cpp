// SPDX-License-Identifier: BSD-3-Clause
// Medit's ASCII mesh (Frey, INRIA RT-0253), which Mmg and other remeshers read. The format has no names, so comments
// list them.
#include "formats/exchange_mesh.hpp"

#include <fmt/format.h>

namespace trime::formats {
namespace {

std::string comments(const ExchangeMesh& mesh) {
  std::string text;
  for (std::size_t k = 0; k < mesh.line_names().size(); ++k)
    text += fmt::format("# edges {}: {}\n", k + 1, mesh.line_names()[k]);
  const std::vector<std::string>& regions = mesh.names().regions;
  for (std::size_t k = 0; k < regions.size(); ++k)
    text += fmt::format("# triangles {}: {}\n", k + 1, regions[k]);
  return text;
}

} // namespace

std::vector<FilePlan> plan_medit(const ExchangeMesh& mesh, const std::string& path) {
  return {{path,
           {mesh.once(fmt::format("MeshVersionFormatted 2\n{}\nDimension 2\n\nVertices\n{}\n", comments(mesh),
                                  mesh.points())),
            mesh.point_rows([&mesh](std::int64_t row, GlobalId, geometry::Vec2 p, std::string& to) {
              append_line(to, p.x, p.y, mesh.point_label(row));
            }),
            mesh.once(fmt::format("\nEdges\n{}\n", mesh.lines())),
            mesh.line_rows([&mesh](std::int64_t row, GlobalId, const std::array<GlobalId, 2>& ends, std::string& to) {
              append_line(to, ends[0] + 1, ends[1] + 1, mesh.line_label(row));
            }),
            mesh.once(fmt::format("\nTriangles\n{}\n", mesh.triangles())),
            mesh.triangle_rows(
                [&mesh](std::int64_t row, GlobalId, const std::array<GlobalId, 3>& corners, std::string& to) {
                  append_line(to, corners[0] + 1, corners[1] + 1, corners[2] + 1, mesh.region(row));
                }),
            mesh.once("\nEnd\n")}}};
}

} // namespace trime::formats
