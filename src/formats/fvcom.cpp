// SPDX-License-Identifier: BSD-3-Clause
// Input files of FVCOM 4 (module mod_setup and subroutines of mod_input): CASE_grd.dat with triangles and points,
// CASE_dep.dat with depths, CASE_obc.dat with the points of the open boundary, and CASE_cor.dat with latitudes, where
// the reference system of the mesh is known. FVCOM reads a file row by row and finds the counts by their names. In the
// files triangles run counter-clockwise; FVCOM turns them round when it reads them.
#include "formats/degrees.hpp"
#include "formats/node_strings.hpp"
#include "formats/open_boundary.hpp"

#include <fmt/format.h>

#include <unordered_set>

namespace trime::formats {
namespace {

// Type of an open boundary in FVCOM at which only the height of the water is prescribed (`ISBCN` = 1).
constexpr std::int64_t prescribed_height = 1;

/// Coordinates of the points of this rank as the files have them. A copy keeps what it needs.
struct FilePlaces {
  bool in_degrees = false;
  LonLat degrees; ///< null if the reference system is unknown

  geometry::Vec2 at(std::int64_t row, geometry::Vec2 p) const {
    return in_degrees ? (*degrees)[static_cast<std::size_t>(row)] : p;
  }
};

/// The points of open parts in the order of the boundary, the mesh on their left. Two open parts that meet share a
/// point, which has one line. On rank 0.
std::string open_boundary_rows(const std::vector<NodeString>& strings, const std::vector<bool>& is_open) {
  std::unordered_set<GlobalId> seen;
  std::string rows;
  for (const NodeString& string : strings)
    if (const auto part = static_cast<std::size_t>(string.label - 1); part < is_open.size() && is_open[part])
      for (const GlobalId point : string.points)
        if (seen.insert(point).second)
          append_line(rows, std::ssize(seen), point + 1, prescribed_height);
  return fmt::format("OBC Node Number = {}\n{}", seen.size(), rows);
}

std::string point_count(const ExchangeMesh& mesh) {
  return fmt::format("Node Number = {}\n", mesh.points());
}

FilePlan grid(const ExchangeMesh& mesh, const std::string& path, const FilePlaces& places) {
  return {path,
          {mesh.once(fmt::format("{}Cell Number = {}\n", point_count(mesh), mesh.triangles())),
           mesh.triangle_rows([](std::int64_t, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
             append_line(to, id + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1);
           }),
           mesh.point_rows([places](std::int64_t row, GlobalId id, geometry::Vec2 p, std::string& to) {
             const geometry::Vec2 place = places.at(row, p);
             append_line(to, id + 1, place.x, place.y);
           })}};
}

/// A file with "x y value" for each point. @param value of a row of this rank
template <class Value>
FilePlan values_at_points(const ExchangeMesh& mesh, const std::string& path, const FilePlaces& places,
                          const Value& value) {
  return {path,
          {mesh.once(point_count(mesh)),
           mesh.point_rows([places, value](std::int64_t row, GlobalId, geometry::Vec2 p, std::string& to) {
             const geometry::Vec2 place = places.at(row, p);
             append_line(to, place.x, place.y, value(static_cast<std::size_t>(row)));
           })}};
}

} // namespace

std::vector<FilePlan> plan_fvcom(const ExchangeMesh& mesh, const std::string& path) {
  const Names& names = mesh.names();
  check_degrees(names); // all ranks find the same
  const FilePlaces places{names.in_degrees, names.crs.empty() ? nullptr : lon_lat_of(mesh, "fvcom")};
  const std::vector<std::string> paths = paths_of(Format::fvcom, path, names);
  std::vector<FilePlan> files{
      grid(mesh, paths[0], places),
      values_at_points(mesh, paths[1], places,
                       [&depth = mesh.mesh().depth](std::size_t row) { return depth ? (*depth)[row] : 0.0; }),
      {paths[2], {mesh.once(open_boundary_rows(node_strings(mesh), open_parts(names)))}}};
  if (places.degrees)
    files.push_back(values_at_points(mesh, paths[3], places,
                                     [degrees = places.degrees](std::size_t row) { return (*degrees)[row].y; }));
  else
    files[0].warning = "the reference system of the coordinates is unknown, so there is no file _cor.dat with the "
                       "latitudes that FVCOM needs for the Coriolis force; write one, or set 'projection' in [shape] "
                       "for a map";
  return files;
}

} // namespace trime::formats
