// SPDX-License-Identifier: BSD-3-Clause
// Reads contours, which are closed rings of vertices, from files of several formats, and finds the transformation that
// puts them into the container. Reading is serial: in a parallel run one rank reads the file and sends the rings to the
// others.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// One closed ring: the last vertex is joined to the first, which is not repeated. A ring may have either orientation.
struct ContourRing {
  std::vector<geometry::Vec2> points;
  /// Line of each vertex in the file, from 1; for a map with features, the number of its feature, from 1.
  std::vector<int> lines;
  /// Marker of the edge from each vertex to the next, as in the file; 0 means no marker. Empty: all markers are 0.
  std::vector<int> markers{};
  /// The vertices as they are in the file, if `points` are their projection; otherwise empty.
  std::vector<geometry::Vec2> in_file{};
  int polygon = 0;   ///< number of the polygon of a map to which the ring belongs, from 1; 0 for lines and other files
  bool open = false; ///< a line of a curve: the last vertex is not joined to the first one
};

/// A feature of a map, for messages.
struct MapFeature {
  int line = 0;     ///< line of its first vertex in the file; 0 for files without lines
  std::string name; ///< value of its attribute `name`, or of another one by which people recognise it; may be empty
};

/// Something for which a file is refused.
struct Fault {
  std::string where;    ///< file and line, and the feature of a map
  std::string what;     ///< what is wrong, with the place
  std::string remedy;   ///< what the user can do
  std::string repaired; ///< what a repair does, as the end of a sentence; empty: a repair is not possible
};

/// The faults of a file: how many there are, and the first ones of both kinds.
struct FaultList {
  std::vector<Fault> first;                 ///< in the order in which they were found
  std::uint64_t repairable = 0, others = 0; ///< numbers of all faults
  bool empty() const { return repairable + others == 0; }
};

/// Says what a reader does with the faults of a file. It can repair faults that have no area: rings with fewer than
/// three distinct vertices, spikes, pairs of edges that cancel each other, and open lines of maps.
enum class Faults {
  refuse,  ///< the reader throws an error that lists them
  collect, ///< they are in Contour::faults, for Part::contour to list them together with those that it finds
  repair,  ///< what has no area is left out, which Part::contour reports in its warnings; other faults are errors
};

/// Rings in the coordinates of their file, unless they are projected. A ring is a hole if it lies inside of an odd
/// number of other rings.
struct Contour {
  std::string source; ///< name used in messages, for example the path
  std::vector<ContourRing> rings;
  std::vector<std::string> warnings; ///< warnings for the user, one sentence each
  /// The warnings among `warnings` about what a `.poly` file has inside of its rings. They help only if no region or
  /// curve reads that. to_bytes() leaves them out.
  std::vector<std::string> inner_warnings{};
  /// Names of the markers 1, 2, ...; empty: markers have no names.
  std::vector<std::string> marker_names{};
  /// Largest area of a triangle in the polygons of each marker of `marker_names`, as a `.poly` file gives it for its
  /// regions; infinite: no limit. Empty: the file has no such limits.
  std::vector<double> largest_areas{};
  std::vector<MapFeature> features{}; ///< features of a map, in the order of the file; empty: the file has no features
  std::string crs{}; ///< name of the reference system of the coordinates, as in the file; empty: unknown
  bool is_map =
      false; ///< true if the rings come from a map: there may be several polygons, and coordinates may be degrees
  bool is_raster = false;       ///< true if the rings run along the sides of cells, which lie on their left; such rings
                                ///< may meet in vertices
  bool in_degrees = false;      ///< true if ContourRing::in_file holds longitudes and latitudes
  bool joins_date_line = false; ///< true if lines that end at longitudes 180 and -180 were joined, in degrees
  FaultList faults{};           ///< faults that the reader has found; what is faulty is not in `rings`
};

/// @brief Reads the rings of a file. The ending of its name decides the format: `.poly` (Triangle), `.shp` and
/// `.asc` (ESRI), `.msh` (JIGSAW), `.geojson` or `.json`; any other file is read as `.xy` text. With a shapefile,
/// NAME.shx is read too, and NAME.prj if it exists. If a `.poly` file has no vertices, they are read from NAME.node.
/// @param hint text that ends the error message if the file cannot be opened
/// @param attribute the attribute of map features that names their boundary, see parse_geojson; empty: no attribute
/// @param faults what happens if rings of the file have faults. A text that cannot be read is always an error
/// @throws ConfigError for formats that are recognised but not supported, or have no attributes; FileError if a file
/// cannot be read; GeometryError `source:line: ...` under the conditions of the parse functions below
/// @note Serial.
Contour read_contour(const std::string& path, const std::string& hint = "", const std::string& attribute = "",
                     Faults faults = Faults::refuse);

/// Reads the rings of a text. The ending of `source` decides the format, as in read_contour.
Contour parse_contour(std::string_view text, const std::string& source, const std::string& attribute = "",
                      Faults faults = Faults::refuse);

/// @brief Reads the polygons of regions inside a shape. In a `.poly` file with region points, the face of the segments
/// around each point is a polygon, and the different attributes of the points are the markers 1, 2, ... and their
/// names. In a raster (`.asc`), each label is a polygon. Other files are read as by read_contour.
/// @throws as read_contour; GeometryError also if segments meet where no vertex is, if a region point lies outside of
/// all faces or in a hole, and if a face has two points
/// @note Serial.
Contour read_regions(const std::string& path, const std::string& hint = "", const std::string& attribute = "");

/// @brief Reads the lines of curves inside a shape from a `.xy`, `.geojson`, `.json`, `.poly` or `.shp` file. They are
/// in Contour::rings, see ContourRing::open: a line that ends where it starts is a ring, as is the border of a polygon.
/// @param attribute the attribute of map features that divides the lines into several curves, see parse_geojson: the
/// markers are those of the features
/// @throws as read_contour, but open lines are not faults
/// @note Serial.
Contour read_curves(const std::string& path, const std::string& hint = "", const std::string& attribute = "");

/// Reads the lines of curves from a text; the ending of `source` decides the format: `.geojson`, `.json` or `.xy`.
Contour parse_curves(std::string_view text, const std::string& source, const std::string& attribute = "");

/// @brief Reads rings of `.xy` text, which has one `x y` per line. A blank line, or a line that starts with `>`, ends a
/// ring; `#` and `;` start comments. Numbers may be separated by a comma. If all lines have the form `10,15;20,55` or
/// `x;y`, the semicolon separates the numbers, and commas are decimal commas.
///
/// Lines end with LF, CR LF or CR. Exponents may be written with `d` (Fortran). A heading such as `x y` or `lon lat` in
/// the first line is skipped with a warning. A ring may repeat its first vertex at its end or not; repeated consecutive
/// vertices are merged with a warning. Coordinates of an airfoil in the formats of Selig or Lednicer, after a line with
/// its name, are one ring. With Faults::repair, a third number is ignored if all lines have one.
/// @throws GeometryError `source:line: ...` for lines that do not hold two finite numbers of at most 1e30, for
/// rings with fewer than three distinct vertices, for a text without vertices, and for UTF-16
Contour parse_xy(std::string_view text, const std::string& source, Faults faults = Faults::refuse);

/// A point with its line in the file.
struct FilePoint {
  geometry::Vec2 position;
  int line;
};

/// @brief Reads points of `.xy` text in the same syntax as parse_xy; ignores blank lines and lines that start with `>`.
/// If `source` ends with `.geojson` or `.json`, the text is read by parse_geojson_points.
/// @throws GeometryError `source:line: ...` for a line that does not hold two finite numbers, and for a text without
/// points
std::vector<FilePoint> parse_points(std::string_view text, const std::string& source);

/// @brief Reads the geometries Point and MultiPoint of a GeoJSON text, and ignores all others. Coordinates are not
/// converted.
/// @throws GeometryError `source:line: ...` for text that is not JSON, a position without two finite numbers, and a
/// text without points
std::vector<FilePoint> parse_geojson_points(std::string_view text, const std::string& source);

/// @brief Reads the rings of the polygons in a GeoJSON text (RFC 7946): a geometry, a feature, or a collection of them.
/// Closed lines are rings as well, and so are lines that form a closed curve together.
///
/// Points are ignored, and so is everything outside of `coordinates`, except the name of a `crs` and the attribute.
/// Coordinates are not converted.
/// @param attribute the property of the features that marks their rings or lines; empty: no property. If all its values
/// are integers, these are the markers. Otherwise the distinct values are numbered in the order of the file; the
/// numbers are the markers and the values their names. A feature without the property has the marker 0
/// @throws GeometryError `source:line: ...` for text that is not JSON, a position without two numbers, lines that are
/// not closed, or a text without polygons; ConfigError if no feature has the attribute
Contour parse_geojson(std::string_view text, const std::string& source, const std::string& attribute = "",
                      Faults faults = Faults::refuse);

/// @brief Reads rings from the segments of a `.poly` file of Triangle, with their markers. Vertices are numbered from 0
/// or 1. Numbers may be separated by commas.
/// Open chains of segments are left out with a warning, and so are segments that have material on both sides.
///
/// The rings enclose the area that Triangle would mesh: everything enclosed by segments, except areas with a hole
/// point. Two rings with the same segments are left out with a warning, and so are vertices without segments and
/// regional attributes.
/// @param nodes text of the `.node` file; needed if the `.poly` file has no vertices
/// @throws GeometryError `source:line: ...` for a text that is not in the `.poly` format, or segments that do not form
/// rings
Contour parse_poly(std::string_view text, const std::string& source, std::string_view nodes = {},
                   Faults faults = Faults::refuse);

/// @brief Reads a raster in the text format of ESRI. The rings enclose all cells with data.
/// @throws GeometryError `source:line: ...` for any other text, for more than 2^26 cells, and if no cell has data
Contour parse_grid(std::string_view text, const std::string& source, Faults faults = Faults::refuse);

/// @brief Reads a raster of labels, which are integers. The cells of each label are a polygon; the labels in ascending
/// order are the markers 1, 2, ... and their names. Where cells of one label meet in a corner only, rings touch there.
/// @throws as parse_grid; GeometryError also for values that are not integers, and for more than 10000 labels
/// Cost: O(cells).
Contour parse_grid_regions(std::string_view text, const std::string& source);

/// @brief Reads rings from the edges (`edge2`) of a two-dimensional mesh or geometry file of JIGSAW; their tags are the
/// markers.
/// @throws GeometryError `source:line: ...` for any other text (also for a `.msh` file of Gmsh), or for edges that do
/// not form rings
Contour parse_jigsaw(std::string_view text, const std::string& source, Faults faults = Faults::refuse);

/// @brief Makes a contour from rings that a program has in memory. In messages, vertices are numbered from 1 through
/// all rings, instead of the lines of a file.
/// @throws GeometryError under the conditions of parse_xy
Contour make_contour(const std::vector<std::vector<geometry::Vec2>>& rings, const std::string& source);

/// Reads the polygons around the region points of a `.poly` text, see read_regions; without region points, the rings of
/// parse_poly.
Contour parse_poly_regions(std::string_view text, const std::string& source, std::string_view nodes = {});

/// @brief Reads the segments of a `.poly` text as the lines of curves, with their markers. A line ends where other than
/// two segments of its marker meet.
/// @throws GeometryError `source:line: ...` for a text that is not in the `.poly` format, or without segments
Contour parse_poly_lines(std::string_view text, const std::string& source, std::string_view nodes = {});

/// Convert a contour to bytes, and back.
std::string to_bytes(const Contour& contour);
Contour contour_of_bytes(std::string_view bytes);

/// A uniform scaling with a shift, from the coordinates of a file to those of the container. Default: identity.
struct Normalization {
  geometry::Vec2 from; ///< point of the file that the transformation moves to `to`
  geometry::Vec2 to;
  double scale = 1;

  geometry::Vec2 apply(geometry::Vec2 p) const { return to + scale * (p - from); }
  geometry::Vec2 undo(geometry::Vec2 p) const { return from + (1 / scale) * (p - to); }
};

/// @brief Returns the transformation that moves the centre of the bounding box of all rings to the centre of the
/// container, and scales the box so that its longer side is 0.8 of the container's shorter side.
/// @throws GeometryError if both sides of the bounding box are below 1e-30
Normalization fit_to_container(const Contour& contour, const geometry::Box& container);

} // namespace trime::contours
