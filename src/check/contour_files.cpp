// SPDX-License-Identifier: BSD-3-Clause
#include "contour_files.hpp"

#include "config_text.hpp"
#include "map_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

namespace trime_check {
namespace {

/// The numbers of the lines that are not empty, without comments.
std::vector<std::vector<double>> number_rows(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> row;
    for (double number = 0; words >> number;)
      row.push_back(number);
    if (!row.empty())
      rows.push_back(std::move(row));
  }
  return rows;
}

using Neighbours = std::map<std::size_t, std::vector<std::size_t>>;

/// Follows segments from vertex to vertex. @return nothing if some vertex has not two of them
std::optional<std::vector<Ring>> rings_of(const Neighbours& neighbours, const std::map<std::size_t, Point>& places) {
  std::map<std::size_t, bool> used;
  std::vector<Ring> rings;
  for (const auto& [first, both] : neighbours) {
    if (used[first])
      continue;
    Ring& ring = rings.emplace_back();
    for (std::size_t before = both[0], at = first; !used[at];) {
      const auto found = neighbours.find(at);
      const auto place = places.find(at);
      if (found == neighbours.end() || found->second.size() != 2 || place == places.end())
        return std::nullopt;
      used[at] = true;
      ring.push_back(place->second);
      const std::size_t next = found->second[0] == before ? found->second[1] : found->second[0];
      before = at;
      at = next;
    }
  }
  return rings;
}

double twice_area_of(const Ring& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::fabs(twice);
}

bool encloses(const Ring& ring, Point p) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
      inside = !inside;
  }
  return inside;
}

/// Returns the number of the smallest ring around p whose area is larger than `above`; the number of rings for none.
std::size_t smallest_around(const std::vector<Ring>& rings, Point p, double above) {
  std::size_t smallest = rings.size();
  for (std::size_t k = 0; k < rings.size(); ++k)
    if (const double area = twice_area_of(rings[k]); area > above && encloses(rings[k], p))
      if (smallest == rings.size() || area < twice_area_of(rings[smallest]))
        smallest = k;
  return smallest;
}

/// Removes the rings with material on both sides. As in Triangle, a ring encloses a hole only if a hole point says so.
std::vector<Ring> around_material(const std::vector<Ring>& rings, const std::vector<Point>& holes) {
  std::vector<char> is_empty(rings.size() + 1, 0);
  is_empty[rings.size()] = 1; // outside of all rings
  for (const Point hole : holes)
    is_empty[smallest_around(rings, hole, 0)] = 1;
  std::vector<Ring> kept;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const Point a = rings[k][0], b = rings[k][1];
    const std::size_t outer = smallest_around(rings, {(a.x + b.x) / 2, (a.y + b.y) / 2}, twice_area_of(rings[k]));
    if (is_empty[outer] != is_empty[k])
      kept.push_back(rings[k]);
  }
  return kept;
}

/// The points of the list in row `first` and behind it. The list may be missing.
std::vector<Point> points_of(const std::vector<std::vector<double>>& rows, std::size_t first) {
  std::vector<Point> points;
  const std::size_t count = first < rows.size() && rows[first][0] > 0 ? static_cast<std::size_t>(rows[first][0]) : 0;
  for (std::size_t k = first + 1; k <= first + count && k < rows.size() && rows[k].size() >= 3; ++k)
    points.push_back({rows[k][1], rows[k][2]});
  return points;
}

/// Triangle's file: a head and vertices, a head and segments, and the holes.
ContourRings read_poly(const std::string& path, const std::string& text) {
  const ContourRings nothing{{}, fmt::format("{}: trime_check finds no closed rings in its segments", path), ""};
  const std::vector<std::vector<double>> rows = number_rows(text);
  const auto count_at = [&](std::size_t row) {
    return row < rows.size() && rows[row][0] >= 0 ? static_cast<std::size_t>(rows[row][0]) : 0;
  };
  const std::size_t vertices = count_at(0), segments = count_at(vertices + 1);
  if (vertices == 0 || segments == 0 || vertices + segments + 2 > rows.size())
    return nothing;
  std::map<std::size_t, Point> places;
  Neighbours neighbours;
  for (std::size_t k = 1; k < vertices + segments + 2; ++k) {
    const std::vector<double>& row = rows[k];
    if (k == vertices + 1)
      continue;
    if (row.size() < 3)
      return nothing;
    if (k <= vertices) {
      places[static_cast<std::size_t>(row[0])] = {row[1], row[2]};
    } else {
      const auto a = static_cast<std::size_t>(row[1]), b = static_cast<std::size_t>(row[2]);
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  }
  std::optional<std::vector<Ring>> rings = rings_of(neighbours, places);
  if (!rings)
    return nothing;
  return {around_material(*rings, points_of(rows, vertices + segments + 2)), "", ""};
}

} // namespace

ContourRings read_contour(const std::string& path, OpenLines lines) {
  const std::optional<std::string> text = read_text(path);
  if (!text)
    return {{}, fmt::format("{} cannot be read", path), ""};
  ContourRings found;
  if (path.ends_with(".xy") || path.ends_with(".txt") || path.ends_with(".dat"))
    found.rings = read_rings(*text);
  else if (path.ends_with(".geojson") || path.ends_with(".json"))
    found = read_geojson(path, *text, lines);
  else if (path.ends_with(".poly"))
    found = read_poly(path, *text);
  else if (path.ends_with(".shp"))
    found = read_shapefile(path, *text, lines);
  else
    found.reason = fmt::format("{}: trime_check reads only lines 'x y', GeoJSON, shapefiles and .poly", path);
  if (found.reason.empty() && found.rings.empty())
    found.reason = fmt::format("{} has no rings", path);
  return found;
}

} // namespace trime_check
