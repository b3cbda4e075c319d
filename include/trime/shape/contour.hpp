// SPDX-License-Identifier: BSD-3-Clause
// Contours: rings of vertices as users draw them, read from `.xy` text or GeoJSON, and their place in the container.
// Reading and parsing are apart, so that one rank can read the bytes and all ranks parse the same text.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::shape {

/// One closed ring: the last vertex is joined to the first, which is not repeated. Either orientation.
struct ContourRing {
  std::vector<geometry::Vec2> points;
  std::vector<int> lines; ///< line of each vertex in the file, from 1
};

/// Rings in the coordinates of their file. Which rings are holes follows from even-odd nesting.
struct Contour {
  std::string source; ///< name used in messages, for example the path
  std::vector<ContourRing> rings;
  std::vector<std::string> warnings; ///< for the user, one sentence each
};

/// @brief Bytes of a contour file. `hint` ends the message if it cannot be opened.
/// @throws ConfigError for `.poly`, `.shp` and others that this version does not read; FileError if it cannot be read
std::string read_contour_text(const std::string& path, const std::string& hint = "");

/// @brief Rings of `.xy` text: one `x y` a line, a blank line or one that starts with `>` ends a ring, `#` and `;`
/// start comments.
///
/// Lines end by LF, CR LF or CR. Exponents may be written with `d` (Fortran). A first line `x y`, `lon lat` or the like
/// is left out with a warning. A ring may repeat its first vertex at its end or not; repeated consecutive vertices are
/// merged with a warning.
/// @throws GeometryError `source:line: ...` for a line that is not two finite numbers of at most 1e30, a ring with
/// fewer than three distinct vertices, a text without vertices, UTF-16
Contour parse_xy(std::string_view text, const std::string& source);

/// A point with its line in the file.
struct FilePoint {
  geometry::Vec2 position;
  int line;
};

/// @brief Points of `.xy` text, as in parse_xy; blank lines and those with `>` mean nothing.
/// @throws GeometryError `source:line: ...` for a line that is not two finite numbers, or without any point
std::vector<FilePoint> parse_points(std::string_view text, const std::string& source);

/// @brief Rings of the polygons of a GeoJSON text (RFC 7946): a geometry, a feature, or a collection of them. Closed
/// lines are rings, too. Points and what lies outside of `coordinates` mean nothing. Numbers are taken as they
/// are, as coordinates in a plane.
/// @throws GeometryError `source:line: ...` for text that is no JSON, a position without two numbers, an open line, a
/// text without polygons
Contour parse_geojson(std::string_view text, const std::string& source);

/// parse_geojson for a source that ends in `.geojson` or `.json`, else parse_xy.
Contour parse_contour(std::string_view text, const std::string& source);
/// read_contour_text and parse_contour.
Contour read_contour(const std::string& path);

/// @brief A contour from rings made by a program; vertices are counted from 1 through all rings in place of lines.
/// @throws GeometryError as parse_xy
Contour make_contour(const std::vector<std::vector<geometry::Vec2>>& rings, const std::string& source);

/// Uniform scaling with a shift: how the coordinates of a file become those of the container. Identity by default.
struct Normalization {
  geometry::Vec2 from; ///< point of the file that goes to `to`
  geometry::Vec2 to;
  double scale = 1;

  geometry::Vec2 apply(geometry::Vec2 p) const { return to + scale * (p - from); }
  geometry::Vec2 undo(geometry::Vec2 p) const { return from + (1 / scale) * (p - to); }
};

/// @brief Moves the centre of the bounding box of all rings to the centre of the container, and scales its longer side
/// to 0.8 of the container's shorter side.
/// @throws GeometryError if both sides are below 1e-30
Normalization fit_to_container(const Contour& contour, const geometry::Box& container);

} // namespace trime::shape
