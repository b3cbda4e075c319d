// SPDX-License-Identifier: BSD-3-Clause
#include "trime/contours/contour.hpp"

#include "contours/airfoil.hpp"
#include "contours/contour_text.hpp"
#include "contours/faults.hpp"
#include "contours/rules.hpp"
#include "contours/segment_rings.hpp"
#include "core/read_file.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace trime::contours {

using geometry::Box;
using geometry::Vec2;

namespace {

/// Third numbers of lines, which many programs write for heights.
class ThirdNumbers {
public:
  std::optional<Vec2> read(std::string_view line, int number) {
    const std::optional<Vec2> p = first_two_of_three(line);
    if (p && ++with_third_ == 1) {
      first_ = number;
      text_ = line.substr(0, most_shown);
    }
    return p;
  }
  /// Counts a line with another number of numbers.
  void count_other() { ++others_; }
  void finish(FaultList& faults, const std::string& source) const {
    if (with_third_ == 0)
      return;
    const bool is_column = others_ == 0;
    add_fault(faults, is_column ? HasArea::no : HasArea::yes, [&]() -> Fault {
      return {fmt::format("{}:{}", source, first_),
              fmt::format("expected two numbers 'x y', found '{}'{}", text_,
                          with_third_ > 1
                              ? fmt::format(", and three numbers in {} of {} lines", with_third_, with_third_ + others_)
                              : ""),
              is_column ? "points in the plane have two numbers: remove the third column"
                        : "points in the plane have two numbers, and not all lines have a third one: correct them",
              is_column ? "the third column is ignored" : ""};
    });
  }

private:
  static constexpr std::size_t most_shown = 60; // characters of a line

  int others_ = 0, with_third_ = 0, first_ = 0;
  std::string text_;
};

/// Reads the rings of lines 'x y'.
void read_lines(std::string_view text, Contour& contour, RingBuilder& builder) {
  VertexReader reader(contour.source);
  ThirdNumbers third;
  for_each_line(text, [&](std::string_view content, int number, bool parts_rings) {
    if (parts_rings)
      return builder.end_ring();
    if (content.empty())
      return;
    if (const std::optional<Vec2> vertex = third.read(content, number))
      return builder.add(*vertex, number);
    const std::uint64_t before = contour.faults.others;
    const std::optional<Vec2> vertex = reader.read(content, number, contour.faults);
    const bool is_fault = contour.faults.others > before;
    if (vertex)
      builder.add(*vertex, number);
    if (is_fault)
      builder.spoil();
    if (vertex || is_fault)
      third.count_other();
  });
  third.finish(contour.faults, contour.source);
  builder.finish();
  contour.warnings.insert(contour.warnings.begin(), reader.warnings().begin(), reader.warnings().end());
}

/// Reads one line after the other; the builder of rings would refuse lines with two vertices.
Contour parse_xy_lines(std::string_view text, const std::string& source) {
  check_encoding(text, source);
  Contour contour;
  contour.source = source;
  const std::optional<std::string> plain = without_semicolons(text, source);
  VertexReader reader(source);
  std::vector<FilePoint> line;
  const auto end_line = [&] {
    if (!line.empty())
      add_line(contour, line, 0);
    line.clear();
  };
  for_each_line(plain ? *plain : text, [&](std::string_view content, int number, bool parts) {
    if (parts)
      return end_line();
    if (content.empty())
      return;
    if (const std::optional<Vec2> p = reader.read(content, number)) {
      check_coordinates(*p, source, number);
      line.push_back({*p, number});
    }
  });
  end_line();
  contour.warnings = reader.warnings();
  if (contour.rings.empty())
    throw GeometryError(fmt::format("{}: expected lines 'x y' of a curve, found none", source));
  return contour;
}

} // namespace

void add_line(Contour& contour, std::span<const FilePoint> vertices, int marker) {
  ContourRing ring;
  ring.open = vertices.size() < 4 || vertices.front().position != vertices.back().position;
  const std::size_t count = ring.open ? vertices.size() : vertices.size() - 1;
  for (const FilePoint& vertex : vertices.first(count)) {
    ring.points.push_back(vertex.position);
    ring.lines.push_back(vertex.line);
  }
  if (marker != 0)
    ring.markers.assign(count, marker);
  if (std::all_of(ring.points.begin(), ring.points.end(), [&](Vec2 p) { return p == ring.points[0]; }))
    throw GeometryError(fmt::format("{}:{}: expected a line with two different points, found one point", contour.source,
                                    vertices.front().line));
  contour.rings.push_back(std::move(ring));
}

Contour parse_xy(std::string_view text, const std::string& source, Faults faults) {
  check_encoding(text, source);
  Contour contour;
  contour.source = source;
  const std::optional<std::string> plain = without_semicolons(text, source);
  RingBuilder builder(contour);
  if (const auto foil = airfoil_of(plain ? *plain : text)) {
    contour.warnings.push_back(fmt::format("{}: read as an airfoil in the format of {}, as one ring{}", source,
                                           foil->format, foil->name.empty() ? "" : ": '" + foil->name + "'"));
    for (const FilePoint& p : foil->points)
      builder.add(p.position, p.line);
    builder.finish();
    check_reading(contour, faults, "the coordinates of an airfoil");
    return contour;
  }
  read_lines(plain ? *plain : text, contour, builder);
  check_reading(contour, faults, "lines 'x y' that make a ring");
  return contour;
}

namespace {

bool ends_with_extension(const std::string& path, std::string_view extension) {
  if (path.size() < extension.size())
    return false;
  for (std::size_t i = 0; i < extension.size(); ++i) {
    const char c = path[path.size() - extension.size() + i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != extension[i])
      return false;
  }
  return true;
}

bool is_geojson(const std::string& path) {
  return ends_with_extension(path, ".geojson") || ends_with_extension(path, ".json");
}

} // namespace

std::vector<FilePoint> parse_points(std::string_view text, const std::string& source) {
  if (is_geojson(source))
    return parse_geojson_points(text, source);
  check_encoding(text, source);
  const std::optional<std::string> plain = without_semicolons(text, source);
  std::vector<FilePoint> points;
  VertexReader reader(source);
  for_each_line(plain ? *plain : text, [&](std::string_view content, int number, bool) {
    if (content.empty())
      return;
    const auto p = reader.read(content, number);
    if (!p) // nobody would hear the warning
      throw GeometryError(fmt::format("{}:{}: expected two numbers 'x y', found the names of columns; put '#' before "
                                      "them",
                                      source, number));
    check_coordinates(*p, source, number);
    points.push_back({*p, number});
  });
  if (points.empty())
    throw GeometryError(fmt::format("{}: expected points, one 'x y' per line, found none", source));
  return points;
}

Contour make_contour(const std::vector<std::vector<Vec2>>& rings, const std::string& source) {
  Contour contour;
  contour.source = source;
  RingBuilder builder(contour);
  int number = 0;
  for (const std::vector<Vec2>& ring : rings) {
    for (const Vec2 p : ring)
      builder.add(p, ++number);
    builder.end_ring();
  }
  builder.finish();
  check_reading(contour, Faults::refuse, "vertices that make a ring");
  return contour;
}

Normalization fit_to_container(const Contour& contour, const Box& container) {
  Box box;
  for (const ContourRing& ring : contour.rings)
    for (const Vec2 p : ring.points)
      box.include(p);
  const double side = std::fmax(box.width(), box.height());
  if (!(side >= ContourRules::smallest_normalized)) // also where all coordinates are equal
    throw GeometryError(fmt::format("{}: the rings are {:g} wide and {:g} high; expected at least {:g} for normalize = "
                                    "true; scale the coordinates up",
                                    contour.source, box.width(), box.height(), ContourRules::smallest_normalized));
  Normalization fit;
  fit.from = 0.5 * (box.min + box.max);
  fit.to = 0.5 * (container.min + container.max);
  fit.scale = ContourRules::normalized_share * std::fmin(container.width(), container.height()) / side;
  return fit;
}

namespace {

void refuse_unread_formats(const std::string& path) {
  for (const std::string_view extension :
       {".kml", ".kmz", ".gpkg", ".dxf", ".svg", ".gml", ".shx", ".dbf", ".zip", ".node"})
    if (ends_with_extension(path, extension))
      throw ConfigError(
          fmt::format("{}: expected a contour file of a known type, found '{}'; known are .xy, .geojson, "
                      ".poly, .shp, .asc or .msh (GDAL reads many formats of maps: ogr2ogr OUT.geojson {})",
                      path, extension, path));
}

void check_has_attributes(const std::string& path, const std::string& attribute) {
  if (!attribute.empty() && !is_geojson(path) && !ends_with_extension(path, ".shp"))
    throw ConfigError(fmt::format("{}: expected a .geojson or .shp, whose features may have the attribute '{}', found "
                                  "a file of another type",
                                  path, attribute));
}

/// Otherwise the brace would count as a mistake in a line 'x y'.
void refuse_geojson(std::string_view text, const std::string& source) {
  if (text.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
    text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '{' && text.find("\"type\"", first) != std::string_view::npos)
    throw GeometryError(
        fmt::format("{}:{}: expected a contour of the type that the ending of the file name says, found "
                    "GeoJSON; rename the file to NAME.geojson",
                    source, 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(first), '\n')));
}

/// Does a `.poly` say that its vertices stand in another file?
bool lacks_vertices(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const std::size_t word = line.find_first_not_of(" \t\r,\xEF\xBB\xBF");
    if (word != std::string_view::npos && line[word] != '#')
      return line[word] == '0';
    at = end + 1;
  }
  return false;
}

/// A raster has a head of words; other texts with this ending are lines 'x y'.
bool is_grid(const std::string& path, std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return ends_with_extension(path, ".asc") && first != std::string_view::npos &&
         std::isalpha(static_cast<unsigned char>(text[first])) != 0;
}

bool is_poly(const std::string& path) {
  return ends_with_extension(path, ".poly");
}

/// Returns the text of the file with the vertices of a `.poly` file that has none; otherwise an empty text.
std::string nodes_of(const std::string& path, std::string_view text) {
  if (!lacks_vertices(text))
    return {};
  const std::string name = path.substr(0, path.size() - std::string_view(".poly").size()) + ".node";
  return read_file(name, fmt::format(" ({} itself has no vertices, so they must be in {})", path, name));
}

} // namespace

Contour parse_contour(std::string_view text, const std::string& source, const std::string& attribute, Faults faults) {
  check_has_attributes(source, attribute);
  if (is_geojson(source))
    return parse_geojson(text, source, attribute, faults);
  refuse_geojson(text, source);
  if (is_poly(source))
    return parse_poly(text, source, {}, faults);
  if (is_grid(source, text))
    return parse_grid(text, source, faults);
  if (ends_with_extension(source, ".msh"))
    return parse_jigsaw(text, source, faults);
  return parse_xy(text, source, faults);
}

Contour read_contour(const std::string& path, const std::string& hint, const std::string& attribute, Faults faults) {
  refuse_unread_formats(path);
  check_has_attributes(path, attribute);
  if (ends_with_extension(path, ".shp"))
    return read_shapefile(path, hint, attribute, faults);
  const std::string text = read_file(path, hint);
  if (is_poly(path))
    return parse_poly(text, path, nodes_of(path, text), faults);
  return parse_contour(text, path, attribute, faults);
}

Contour read_regions(const std::string& path, const std::string& hint, const std::string& attribute) {
  if (!is_poly(path) && !ends_with_extension(path, ".asc"))
    return read_contour(path, hint, attribute);
  check_has_attributes(path, attribute);
  const std::string text = read_file(path, hint);
  if (is_grid(path, text))
    return parse_grid_regions(text, path);
  return !is_poly(path) ? parse_contour(text, path) : parse_poly_regions(text, path, nodes_of(path, text));
}

Contour parse_curves(std::string_view text, const std::string& source, const std::string& attribute) {
  check_has_attributes(source, attribute);
  if (is_geojson(source))
    return parse_geojson_lines(text, source, attribute);
  refuse_geojson(text, source);
  return is_poly(source) ? parse_poly_lines(text, source) : parse_xy_lines(text, source);
}

Contour read_curves(const std::string& path, const std::string& hint, const std::string& attribute) {
  refuse_unread_formats(path);
  check_has_attributes(path, attribute);
  for (const std::string_view extension : {".msh", ".asc"})
    if (ends_with_extension(path, extension))
      throw ConfigError(
          fmt::format("{}: expected a file with the lines of a curve, found '{}'; known are .xy, .geojson, "
                      ".poly and .shp",
                      path, extension));
  if (ends_with_extension(path, ".shp"))
    return read_shapefile_lines(path, hint, attribute);
  const std::string text = read_file(path, hint);
  return is_poly(path) ? parse_poly_lines(text, path, nodes_of(path, text)) : parse_curves(text, path, attribute);
}

} // namespace trime::contours
