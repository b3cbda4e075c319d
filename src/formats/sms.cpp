// SPDX-License-Identifier: BSD-3-Clause
// 2DM of Aquaveo's SMS, which QGIS (MDAL), Telemac's and SRH-2D's tools read: elements with their region as material,
// points at their height, and a node string for each run of boundary edges of one part. The name of the mesh lists the
// names.
#include "formats/degrees.hpp"
#include "formats/node_strings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trime::formats {
namespace {

constexpr std::size_t points_of_line = 10;

std::string mesh_name(const Names& names) {
  std::string text = "MESHNAME \"";
  for (std::size_t k = 0; k < names.parts.size(); ++k)
    text += fmt::format("{}node string {}: {}", k == 0 ? "" : ", ", k + 1, names.parts[k]);
  for (std::size_t k = 0; k < std::min(names.curves.size(), names.curve_kinds.size()); ++k)
    if (names.curve_kinds[k].split)
      text += fmt::format(", node string {}: {}", names.parts.size() + k + 1, names.curves[k]);
  for (std::size_t k = 0; names.regions.size() > 1 && k < names.regions.size(); ++k)
    text += fmt::format(", material {}: {}", k + 1, names.regions[k]);
  return text + "\"\n";
}

/// The last point of a string is negative, and its label follows.
std::string string_lines(const std::vector<NodeString>& strings) {
  std::string text;
  for (const NodeString& string : strings) {
    const std::size_t count = string.points.size() + (string.is_closed ? 1 : 0);
    for (std::size_t k = 0; k < count; ++k) {
      const GlobalId id = string.points[k % string.points.size()] + 1;
      text += fmt::format("{} {}", k % points_of_line == 0 ? "NS" : "", k + 1 == count ? -id : id);
      text += k + 1 == count                             ? fmt::format(" {}\n", string.label)
              : k % points_of_line + 1 == points_of_line ? "\n"
                                                         : "";
    }
  }
  return text;
}

} // namespace

std::vector<FilePlan> plan_sms(const ExchangeMesh& mesh, const std::string& path) {
  return {{path,
           {mesh.once("MESH2D\n" + mesh_name(mesh.names())),
            mesh.triangle_rows(
                [&mesh](std::int64_t row, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
                  to += "E3T ";
                  append_line(to, id + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1, mesh.region(row));
                }),
            numbered_points(mesh, {"ND ", "2dm", Height::elevation}), mesh.once(string_lines(node_strings(mesh)))}}};
}

} // namespace trime::formats
