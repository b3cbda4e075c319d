// SPDX-License-Identifier: BSD-3-Clause
// The native mesh of SU2 (documentation, "Mesh File"): triangles, points, and a marker for each named part of the
// boundary. A marker of SU2 has edges on the boundary only, so curves and interfaces are left out, except for the sides
// of curves that are split.
#include "formats/exchange_mesh.hpp"
#include "formats/solver_names.hpp"

#include <fmt/format.h>

namespace trime::formats {
namespace {

constexpr std::int64_t vtk_line = 3, vtk_triangle = 5;

/// Labels of the edges on the boundary, each once, in ascending order.
std::vector<std::int64_t> boundary_labels(const ExchangeMesh& mesh, std::vector<std::int64_t>& counts) {
  counts.assign(mesh.line_names().size() + 1, 0);
  for (const std::int32_t part : mesh.mesh().facet_parts)
    ++counts[static_cast<std::size_t>(part) + 1];
  mesh.comm().sum(counts);
  std::vector<std::int64_t> labels;
  for (std::size_t label = 1; label < counts.size(); ++label)
    if (counts[label] > 0)
      labels.push_back(static_cast<std::int64_t>(label));
  return labels;
}

io::TextRows marker_rows(const ExchangeMesh& mesh, std::int64_t label) {
  return {std::ssize(mesh.mesh().facets), [&mesh, label](std::int64_t row, std::string& to) {
            const auto k = static_cast<std::size_t>(row);
            if (mesh.mesh().facet_parts[k] + 1 == label)
              append_line(to, vtk_line, mesh.mesh().facets[k][0], mesh.mesh().facets[k][1]);
          }};
}

} // namespace

std::vector<FilePlan> plan_su2(const ExchangeMesh& mesh, const std::string& path) {
  FilePlan file{
      path,
      {mesh.once(fmt::format("NDIME= 2\nNELEM= {}\n", mesh.triangles())),
       mesh.triangle_rows([](std::int64_t, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
         append_line(to, vtk_triangle, corners[0], corners[1], corners[2], id);
       }),
       mesh.once(fmt::format("NPOIN= {}\n", mesh.points())),
       mesh.point_rows(
           [](std::int64_t, GlobalId id, geometry::Vec2 p, std::string& to) { append_line(to, p.x, p.y, id); })}};
  std::vector<std::int64_t> counts;
  const std::vector<std::int64_t> labels = boundary_labels(mesh, counts);
  const std::vector<std::string> tags = solver_names(mesh.line_names()); // a blank would end a tag
  file.rows.push_back(mesh.once(fmt::format("NMARK= {}\n", labels.size())));
  for (const std::int64_t label : labels) {
    const auto k = static_cast<std::size_t>(label);
    file.rows.push_back(mesh.once(fmt::format("MARKER_TAG= {}\nMARKER_ELEMS= {}\n", tags[k - 1], counts[k])));
    file.rows.push_back(marker_rows(mesh, label));
  }
  return {file};
}

} // namespace trime::formats
