// SPDX-License-Identifier: BSD-3-Clause
// The mesh file of FreeFEM++ ("mesh type msh" of its manual), in two dimensions: `mesh Th("NAME.freefem")` reads it;
// `readmesh` takes the ending .msh only, which is Gmsh's here. It has no names.
#include "formats/exchange_mesh.hpp"

#include <fmt/format.h>

namespace trime::formats {

std::vector<FilePlan> plan_freefem(const ExchangeMesh& mesh, const std::string& path) {
  return {{path,
           {mesh.once(fmt::format("{} {} {}\n", mesh.points(), mesh.triangles(), mesh.lines())),
            mesh.point_rows([&mesh](std::int64_t row, GlobalId, geometry::Vec2 p, std::string& to) {
              append_line(to, p.x, p.y, mesh.point_label(row));
            }),
            mesh.triangle_rows(
                [&mesh](std::int64_t row, GlobalId, const std::array<GlobalId, 3>& corners, std::string& to) {
                  append_line(to, corners[0] + 1, corners[1] + 1, corners[2] + 1, mesh.region(row));
                }),
            mesh.line_rows([&mesh](std::int64_t row, GlobalId, const std::array<GlobalId, 2>& ends, std::string& to) {
              append_line(to, ends[0] + 1, ends[1] + 1, mesh.line_label(row));
            })}}};
}

} // namespace trime::formats
