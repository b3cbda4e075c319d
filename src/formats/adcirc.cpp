// SPDX-License-Identifier: BSD-3-Clause
// fort.14 of ADCIRC (user's manual, "ADCIRC Grid and Boundary Information File"), which other coastal models read too:
// depth 0; boundary segments by the names of the parts. A part that is not open is land: an island where it goes round
// a hole, mainland elsewhere.
#include "formats/degrees.hpp"
#include "formats/node_strings.hpp"
#include "formats/open_boundary.hpp"

#include <fmt/format.h>

namespace trime::formats {
namespace {

constexpr int mainland = 20, island = 21; // with the natural condition of no flow

struct Group {
  std::string text;
  std::int64_t segments = 0, points = 0;

  void add(const NodeString& string, const std::string& head, const std::string& name) {
    const std::size_t count = string.points.size() + (string.is_closed ? 1 : 0);
    text += fmt::format("{}{} = {}\n", count, head, name);
    for (std::size_t k = 0; k < count; ++k)
      text += fmt::format("{}\n", string.points[k % string.points.size()] + 1);
    ++segments;
    points += static_cast<std::int64_t>(count);
  }
};

std::string boundary_text(const std::vector<NodeString>& strings, const Names& names) {
  const std::vector<bool> is_open = open_parts(names);
  Group open, land;
  for (const NodeString& string : strings) {
    const auto part = static_cast<std::size_t>(string.label - 1);
    const std::string& name = names.parts[part];
    if (is_open[part])
      open.add(string, "", name);
    else
      land.add(string, fmt::format(" {}", string.is_island ? island : mainland), name);
  }
  return fmt::format("{} = open boundaries\n{} = points on them\n{}{} = land boundaries\n{} = points on them\n{}",
                     open.segments, open.points, open.text, land.segments, land.points, land.text);
}

} // namespace

std::vector<FilePlan> plan_adcirc(const ExchangeMesh& mesh, const std::string& path) {
  const std::string& title = mesh.names().regions.size() == 1 ? mesh.names().regions[0] : path;
  return {{path,
           {mesh.once(fmt::format("{}\n{} {}\n", title, mesh.triangles(), mesh.points())),
            numbered_points(mesh, "", "fort14"),
            mesh.triangle_rows([](std::int64_t, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
              append_line(to, id + 1, std::int64_t{3}, corners[0] + 1, corners[1] + 1, corners[2] + 1);
            }),
            mesh.once(boundary_text(node_strings(mesh), mesh.names()))}}};
}

} // namespace trime::formats
