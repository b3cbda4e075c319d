// SPDX-License-Identifier: BSD-3-Clause
#include "contours/ascii_grid.hpp"

#include "contours/contour_text.hpp"
#include "trime/core/error.hpp"

#include <fmt/core.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace trime::contours {
namespace {

constexpr double most_cells = 1 << 26; // a text of about 200 MB

/// The head of a file, by its keys in lower case.
class GridHead {
public:
  explicit GridHead(const std::string& source) : source_(source) {}

  /// Reads a line of the head. Returns false for the first line of values.
  bool take(const WordLines& lines) {
    const std::string_view word = lines.words()[0];
    if (std::isalpha(static_cast<unsigned char>(word[0])) == 0)
      return false;
    std::string key;
    for (const char c : word)
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (key == "nan") // a value
      return false;
    values_[key] = lines.number_at(1, "a key of an ESRI grid and a number, such as 'cellsize 30'");
    return true;
  }

  double needed(const char* key) const {
    const std::optional<double> value = given(key);
    if (!value)
      throw GeometryError(fmt::format("{}: expected the head of an ESRI ASCII grid, found no line '{} NUMBER'; GDAL "
                                      "converts other rasters: gdal_translate -of AAIGrid IN.tif OUT.asc",
                                      source_, key));
    return *value;
  }
  std::optional<double> given(const char* key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }
  int count(const char* key) const {
    const double value = needed(key);
    if (!(value >= 1 && value <= most_cells && value == std::trunc(value)))
      throw GeometryError(fmt::format("{}: expected {} from 1 to 2^26, found {:g}", source_, key, value));
    return static_cast<int>(value);
  }
  /// The width or the height of a cell.
  double step(const char* key) const {
    const double value = given(key) ? needed(key) : needed("cellsize");
    if (!(value > 0 && std::isfinite(value)))
      throw GeometryError(fmt::format("{}: expected a positive size of the cells, found {:g}", source_, value));
    return value;
  }
  /// A coordinate of the lower left corner. @param half half of the size of a cell
  double corner(const char* at_corner, const char* at_centre, double half) const {
    if (const std::optional<double> centre = given(at_centre); centre && !given(at_corner))
      return *centre - half;
    return needed(at_corner);
  }

private:
  const std::string& source_;
  std::map<std::string, double> values_;
};

AsciiGrid grid_of(const GridHead& head, const std::string& source) {
  AsciiGrid grid;
  grid.columns = head.count("ncols");
  grid.rows = head.count("nrows");
  if (static_cast<double>(grid.columns) * grid.rows > most_cells)
    throw GeometryError(fmt::format("{}: expected at most 2^26 cells, found {} x {}; gdal_translate -outsize makes a "
                                    "coarser raster",
                                    source, grid.columns, grid.rows));
  grid.cell = {head.step("dx"), head.step("dy")};
  grid.corner = {head.corner("xllcorner", "xllcenter", grid.cell.x / 2),
                 head.corner("yllcorner", "yllcenter", grid.cell.y / 2)};
  return grid;
}

} // namespace

AsciiGrid read_ascii_grid(std::string_view text, const std::string& source) {
  check_encoding(text, source);
  WordLines lines(text, source, ",");
  GridHead head(source);
  bool more = lines.next();
  while (more && head.take(lines))
    more = lines.next();
  AsciiGrid grid = grid_of(head, source);
  grid.first_line = lines.number();
  const double empty = head.given("nodata_value").value_or(std::numeric_limits<double>::quiet_NaN());
  const std::size_t cells = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  for (; more; more = lines.next())
    for (std::size_t k = 0; k < lines.words().size(); ++k) {
      if (grid.values.size() == cells)
        lines.refuse(fmt::format("the end of the file after {} x {} values", grid.columns, grid.rows));
      const bool is_nan = lines.words()[k] == "nan" || lines.words()[k] == "NaN";
      const double value = is_nan ? empty : lines.number_at(k, "a number");
      grid.values.push_back(is_nan || value == empty ? std::numeric_limits<double>::quiet_NaN() : value);
    }
  if (grid.values.size() < cells)
    throw GeometryError(
        fmt::format("{}: expected {} x {} values, found only {}", source, grid.columns, grid.rows, grid.values.size()));
  check_coordinates(grid.corner, source, 1);
  check_coordinates(grid.corner + geometry::Vec2{grid.columns * grid.cell.x, grid.rows * grid.cell.y}, source, 1);
  return grid;
}

} // namespace trime::contours
