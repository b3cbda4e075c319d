// SPDX-License-Identifier: BSD-3-Clause
// Contours: rings of vertices that are read from files of several formats, and their place in the container. Reading is
// serial: in a parallel run one rank reads and sends the rings to the others.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// One closed ring: the last vertex is joined to the first, which is not repeated. It may have either orientation.
struct ContourRing {
  std::vector<geometry::Vec2> points;
  std::vector<int> lines; ///< line of each vertex in the file, from 1; for a shapefile, the number of its record
  /// Marker of the edge from each vertex to the next, as in the file; empty: all are 0, which means no marker.
  std::vector<int> markers{};
  /// The vertices as they are in the file, if `points` are projected from them; else empty.
  std::vector<geometry::Vec2> in_file{};
};

/// Rings in the coordinates of their file, unless they are projected. Which rings are holes follows from even-odd
/// nesting.
struct Contour {
  std::string source; ///< name used in messages, for example the path
  std::vector<ContourRing> rings;
  std::vector<std::string> warnings; ///< for the user, one sentence each
  /// Names of the markers 1, 2, ...; empty: markers have no names.
  std::vector<std::string> marker_names{};
  std::string crs{};   ///< reference system of the coordinates, as in the file; empty: unknown
  bool is_map = false; ///< made of the features of a map: it may have several polygons, and coordinates may be degrees
};

/// @brief Reads the rings of a file. Its name ends in `.poly` (Triangle), `.shp` (ESRI), `.msh` (JIGSAW), `.geojson` or
/// `.json`, else it is `.xy` text. With a shapefile NAME.shx is read, too, and NAME.prj if it exists; with a `.poly`
/// without vertices NAME.node.
/// @param hint ends the message if the file cannot be opened
/// @param attribute attribute of the features of a map that names the boundary, see parse_geojson; empty: no attribute
/// @throws ConfigError for formats that are known but not read, or have no attributes; FileError if a file cannot be
/// read; GeometryError `source:line: ...` as the functions below
/// @note Serial.
Contour read_contour(const std::string& path, const std::string& hint = "", const std::string& attribute = "");

/// Reads the rings of a text in the format that the ending of `source` names.
Contour parse_contour(std::string_view text, const std::string& source, const std::string& attribute = "");

/// @brief Reads rings of `.xy` text: one `x y` per line. A blank line, or one that starts with `>`, ends a ring; `#`
/// and `;` start comments. A comma may stand between the numbers.
///
/// Lines end by LF, CR LF or CR. Exponents may be written with `d` (Fortran). A first line `x y`, `lon lat` or the like
/// is left out with a warning. A ring may repeat its first vertex at its end or not; repeated consecutive vertices are
/// merged with a warning.
/// @throws GeometryError `source:line: ...` for a line that is not two finite numbers of at most 1e30, a ring with
/// fewer than three distinct vertices, a text without vertices, or UTF-16
Contour parse_xy(std::string_view text, const std::string& source);

/// A point with its line in the file.
struct FilePoint {
  geometry::Vec2 position;
  int line;
};

/// @brief Reads points of `.xy` text, as in parse_xy; ignores blank lines and those with `>`.
/// @throws GeometryError `source:line: ...` for a line that is not two finite numbers, or without any point
std::vector<FilePoint> parse_points(std::string_view text, const std::string& source);

/// @brief Reads rings of the polygons of a GeoJSON text (RFC 7946): a geometry, a feature, or a collection of them.
/// Lines that end where they start are rings, too, and so are lines that join at their ends.
///
/// Points are ignored, and so is everything outside of `coordinates`, except the name of a `crs` and the attribute.
/// Numbers are taken as they are.
/// @param attribute property of the features that marks their rings or lines; empty: no property. If all its values are
/// integers, they are the markers. Otherwise markers number the values in the order of the file, and the values are
/// their names. Features without it have the marker 0
/// @throws GeometryError `source:line: ...` for text that is not JSON, a position without two numbers, an open line, or
/// a text without polygons; ConfigError if no feature has the attribute
Contour parse_geojson(std::string_view text, const std::string& source, const std::string& attribute = "");

/// @brief Reads rings of the segments of a `.poly` file of Triangle, with their markers. Vertex numbers begin with 0 or
/// 1. Commas separate numbers, too.
///
/// The rings enclose what Triangle meshes: everything within segments, except areas with a hole point. Rings with equal
/// sides are left out with a warning, and so are vertices without segments and regional attributes.
/// @param nodes text of the `.node` file, for a `.poly` without vertices
/// @throws GeometryError `source:line: ...` for a text that is not a `.poly`, or segments that do not form rings
Contour parse_poly(std::string_view text, const std::string& source, std::string_view nodes = {});

/// @brief Reads rings of the edges (`edge2`) of a plane mesh or geometry of JIGSAW, with their tags as markers.
/// @throws GeometryError `source:line: ...` for any other text, also a `.msh` of Gmsh, or edges that do not form rings
Contour parse_jigsaw(std::string_view text, const std::string& source);

/// @brief Makes a contour from rings of a program; vertices are numbered from 1 through all rings, in place of lines.
/// @throws GeometryError as parse_xy
Contour make_contour(const std::vector<std::vector<geometry::Vec2>>& rings, const std::string& source);

/// Convert a contour to bytes, and back.
std::string to_bytes(const Contour& contour);
Contour contour_of_bytes(std::string_view bytes);

/// Uniform scaling with a shift: from coordinates of a file to those of the container. Identity by default.
struct Normalization {
  geometry::Vec2 from; ///< point of the file that is moved to `to`
  geometry::Vec2 to;
  double scale = 1;

  geometry::Vec2 apply(geometry::Vec2 p) const { return to + scale * (p - from); }
  geometry::Vec2 undo(geometry::Vec2 p) const { return from + (1 / scale) * (p - to); }
};

/// @brief Moves the centre of the bounding box of all rings to the centre of the container, and scales its longer side
/// to 0.8 of the container's shorter side.
/// @throws GeometryError if both sides are below 1e-30
Normalization fit_to_container(const Contour& contour, const geometry::Box& container);

} // namespace trime::contours
