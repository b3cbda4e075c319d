// SPDX-License-Identifier: BSD-3-Clause
#include "formats/degrees.hpp"

#include "comm/agree.hpp"
#include "projection/projection.hpp"
#include "trime/core/error.hpp"

namespace trime::formats {

void to_degrees(std::vector<geometry::Vec2>& places, const std::string& crs, const char* format) {
  const projection::Transform transform(projection::lon_lat, crs);
  for (geometry::Vec2& p : places) {
    const auto place = transform.undo(p);
    if (!place)
      throw FileError(fmt::format("the point {} of the mesh has no longitude and latitude, which the format {} needs; "
                                  "write another format",
                                  Place(p), format));
    p = *place;
  }
}

LonLat lon_lat_of(const ExchangeMesh& mesh, const char* format) {
  const auto places =
      std::make_shared<std::vector<geometry::Vec2>>(mesh.mesh().points.begin(), mesh.mesh().points.end());
  comm::run_agreed(mesh.comm(), [&] { to_degrees(*places, mesh.names().crs, format); });
  return places;
}

void check_degrees(const Names& names) {
  if (names.in_degrees && names.crs.empty())
    throw ConfigError("'coordinates = degrees' needs a mesh whose reference system is known, found none; set "
                      "'projection = auto' in [shape] for contours in longitude and latitude; without 'coordinates' "
                      "the files have the coordinates of the mesh");
}

io::TextRows numbered_points(const ExchangeMesh& mesh, const PointStyle& style) {
  const auto height = [&depth = mesh.mesh().depth, is_depth = style.height == Height::depth](std::int64_t row) {
    const double value = depth ? (*depth)[static_cast<std::size_t>(row)] : 0.0;
    return is_depth || value == 0 ? value : -value; // no -0
  };
  if (!mesh.names().in_degrees)
    return mesh.point_rows(
        [start = style.start, height](std::int64_t row, GlobalId id, geometry::Vec2 p, std::string& to) {
          to += start;
          append_line(to, id + 1, p.x, p.y, height(row));
        });
  check_degrees(mesh.names()); // all ranks find the same
  const LonLat places = lon_lat_of(mesh, style.format);
  return mesh.point_rows(
      [start = style.start, height, places](std::int64_t row, GlobalId id, geometry::Vec2, std::string& to) {
        const geometry::Vec2 p = (*places)[static_cast<std::size_t>(row)];
        to += start;
        append_line(to, id + 1, p.x, p.y, height(row));
      });
}

} // namespace trime::formats
