// SPDX-License-Identifier: BSD-3-Clause
// The files of Triangle (Shewchuk, https://www.cs.cmu.edu/~quake/triangle.html): .node and .edge with boundary markers,
// .ele with the region as its attribute. Numbers begin with 1; .edge holds the boundary only.
#include "formats/exchange_mesh.hpp"

#include <fmt/format.h>

namespace trime::formats {
namespace {

std::string comments(const char* what, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += fmt::format("# {} {}: {}\n", what, k + 1, names[k]);
  return text;
}

} // namespace

std::vector<FilePlan> plan_triangle(const ExchangeMesh& mesh, const std::string& path) {
  const std::vector<std::string> paths = paths_of(Format::triangle, path);
  return {
      {paths[0],
       {mesh.once(fmt::format("{} 2 0 1\n", mesh.points())),
        mesh.point_rows([&mesh](std::int64_t row, GlobalId id, geometry::Vec2 p, std::string& to) {
          append_line(to, id + 1, p.x, p.y, mesh.point_label(row));
        }),
        mesh.once(comments("marker", mesh.names().parts))}},
      {paths[1],
       {mesh.once(fmt::format("{} 3 1\n", mesh.triangles())),
        mesh.triangle_rows(
            [&mesh](std::int64_t row, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
              append_line(to, id + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1, mesh.region(row));
            }),
        mesh.once(comments("region", mesh.names().regions))}},
      {paths[2],
       {mesh.once(fmt::format("{} 1\n", mesh.facets())),
        mesh.facet_rows([&mesh](std::int64_t row, GlobalId id, const std::array<GlobalId, 2>& ends, std::string& to) {
          append_line(to, id + 1, ends[0] + 1, ends[1] + 1, mesh.facet_label(row));
        }),
        mesh.once(comments("marker", mesh.names().parts))}}};
}

} // namespace trime::formats
