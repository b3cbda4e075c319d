// SPDX-License-Identifier: BSD-3-Clause
#include "contour_files.hpp"

#include "config_text.hpp"
#include "map_files.hpp"

#include <fmt/format.h>

#include <array>
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

/// Triangle's file: a head and vertices, a head and segments; what follows says where the holes are.
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
  return rings ? ContourRings{std::move(*rings), "", ""} : nothing;
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
