// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.hpp"

#include "config_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace trime_check {
namespace {

bool same(Point a, Point b) {
  return a.x == b.x && a.y == b.y;
}

/// Collects the lines and polygons of a map.
class MapRings {
public:
  void begin_polygon() { ++polygons_; }
  void add_polygon_ring(Ring ring) { add_ring(std::move(ring), polygons_); }
  void add_line(Ring line) {
    if (line.size() > 2 && same(line.front(), line.back()))
      add_ring(std::move(line), 0);
    else if (line.size() > 1)
      open_.push_back(std::move(line));
  }

  /// Joins open lines at their ends. @return false if an end is that of one line, or of more than two
  bool join() {
    const Ends ends = ends_of_lines();
    for (const auto& [place, lines] : ends)
      if (lines.size() != 2)
        return false;
    std::vector<bool> used(open_.size(), false);
    for (std::size_t first = 0; first < open_.size(); ++first) {
      if (used[first])
        continue;
      Ring ring;
      Point at = open_[first].front();
      for (std::size_t k = first; !used[k];) {
        used[k] = true;
        const Ring& line = open_[k];
        const bool forward = key(line.front()) == key(at);
        for (std::size_t j = 0; j + 1 < line.size(); ++j)
          ring.push_back(forward ? line[j] : line[line.size() - 1 - j]);
        at = forward ? line.back() : line.front();
        const std::vector<std::size_t>& both = ends.at(key(at));
        k = both[0] == k ? both[1] : both[0];
      }
      add_ring(std::move(ring), 0);
    }
    return true;
  }

  /// Returns the rings with the name of their reference system, or says why they cannot be joined.
  ContourRings finish(const std::string& path, std::string crs, OpenLines lines) {
    drop_repeated_lines();
    if (lines == OpenLines::leave_out)
      leave_out_open();
    if (!join())
      return {{}, fmt::format("{}: trime_check joins lines only where two of them end", path), ""};
    return {std::move(rings_), "", std::move(crs), std::move(polygon_)};
  }

private:
  using Ends = std::map<std::pair<double, double>, std::vector<std::size_t>>; // lines that end at each place

  /// Maps are cut at the date line: both sides are one place.
  static std::pair<double, double> key(Point end) {
    constexpr double date_line = 180;
    return {end.x == -date_line ? date_line : end.x, end.y};
  }

  Ends ends_of_lines() const {
    Ends ends;
    for (std::size_t k = 0; k < open_.size(); ++k)
      for (const Point end : {open_[k].front(), open_[k].back()})
        ends[key(end)].push_back(k);
    return ends;
  }

  /// Keeps the first one of lines with the same vertices, in any direction.
  void drop_repeated_lines() {
    std::set<std::vector<std::pair<double, double>>> seen;
    std::erase_if(open_, [&](const Ring& line) {
      std::vector<std::pair<double, double>> there, back;
      for (const Point p : line)
        there.emplace_back(p.x, p.y);
      back.assign(there.rbegin(), there.rend());
      return !seen.insert(std::min(there, back)).second;
    });
  }

  /// Removes lines with an end that is theirs alone, until none is left.
  void leave_out_open() {
    for (std::size_t before = open_.size() + 1; open_.size() < before;) {
      before = open_.size();
      const Ends ends = ends_of_lines();
      std::erase_if(open_, [&](const Ring& line) {
        return ends.at(key(line.front())).size() == 1 || ends.at(key(line.back())).size() == 1;
      });
    }
  }

  void add_ring(Ring ring, int polygon) {
    if (ring.size() > 1 && same(ring.front(), ring.back()))
      ring.pop_back();
    rings_.push_back(std::move(ring));
    polygon_.push_back(polygon);
  }

  std::vector<Ring> rings_, open_;
  std::vector<int> polygon_; // of each ring
  int polygons_ = 0;
};

Ring ring_of(const nlohmann::json& positions) {
  Ring ring;
  for (const nlohmann::json& position : positions)
    ring.push_back({position.at(0).get<double>(), position.at(1).get<double>()});
  return ring;
}

void add_geometry(const nlohmann::json& geometry, MapRings& rings) {
  if (geometry.is_null())
    return;
  const std::string type = geometry.at("type").get<std::string>();
  if (type == "GeometryCollection") {
    for (const nlohmann::json& member : geometry.at("geometries"))
      add_geometry(member, rings);
    return;
  }
  const nlohmann::json& coordinates = geometry.at("coordinates");
  if (type == "Polygon") {
    rings.begin_polygon();
    for (const nlohmann::json& ring : coordinates)
      rings.add_polygon_ring(ring_of(ring));
  } else if (type == "MultiPolygon") {
    for (const nlohmann::json& polygon : coordinates) {
      rings.begin_polygon();
      for (const nlohmann::json& ring : polygon)
        rings.add_polygon_ring(ring_of(ring));
    }
  } else if (type == "LineString") {
    rings.add_line(ring_of(coordinates));
  } else if (type == "MultiLineString") {
    for (const nlohmann::json& line : coordinates)
      rings.add_line(ring_of(line));
  }
}

/// The bytes of a shapefile: integers are four bytes long, with the highest byte first in the heads of records.
/// @throws std::out_of_range behind the end
class Bytes {
public:
  explicit Bytes(const std::string& bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  std::uint64_t big_integer(std::size_t at) const { return number(at, 4, true); }
  std::uint64_t integer(std::size_t at) const { return number(at, 4, false); }
  double real(std::size_t at) const { return std::bit_cast<double>(number(at, 8, false)); }

private:
  std::uint64_t number(std::size_t at, std::size_t count, bool highest_first) const {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < count; ++k)
      value = value << 8 | static_cast<unsigned char>(bytes_.at(at + (highest_first ? k : count - 1 - k)));
    return value;
  }

  const std::string& bytes_;
};

/// Adds the parts of the record whose content begins at `at`.
void add_record(const Bytes& bytes, std::size_t at, MapRings& rings) {
  const std::uint64_t type = bytes.integer(at) % 10; // 13 and 23 have heights and measures in addition to those of 3
  constexpr std::uint64_t line = 3, polygon = 5;
  if (type != line && type != polygon)
    return;
  constexpr std::size_t box_end = 36; // type and bounding box
  const std::uint64_t parts = bytes.integer(at + box_end), points = bytes.integer(at + box_end + 4);
  rings.begin_polygon();
  const std::size_t first_part = at + box_end + 8, first_point = first_part + 4 * parts;
  for (std::uint64_t k = 0; k < parts; ++k) {
    const std::uint64_t end = k + 1 < parts ? bytes.integer(first_part + 4 * (k + 1)) : points;
    Ring ring;
    for (std::uint64_t j = bytes.integer(first_part + 4 * k); j < end; ++j)
      ring.push_back({bytes.real(first_point + 16 * j), bytes.real(first_point + 16 * j + 8)});
    if (type == polygon)
      rings.add_polygon_ring(std::move(ring));
    else
      rings.add_line(std::move(ring));
  }
}

/// The name of the reference system that GeoJSON had until 2016.
std::string crs_of(const nlohmann::json& json) {
  const auto at = nlohmann::json::json_pointer("/crs/properties/name");
  return json.contains(at) && json.at(at).is_string() ? json.at(at).get<std::string>() : std::string();
}

} // namespace

ContourRings read_geojson(const std::string& path, const std::string& text, OpenLines lines) {
  MapRings rings;
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.at("type") == "FeatureCollection")
      for (const nlohmann::json& feature : json.at("features"))
        add_geometry(feature.at("geometry"), rings);
    else
      add_geometry(json.at("type") == "Feature" ? json.at("geometry") : json, rings);
    return rings.finish(path, crs_of(json), lines);
  } catch (const nlohmann::json::exception&) {
    return {{}, fmt::format("{} cannot be read", path), ""};
  }
}

ContourRings read_shapefile(const std::string& path, const std::string& text, OpenLines lines) {
  constexpr std::size_t head = 100, record_head = 8; // [bytes]
  const Bytes bytes(text);
  MapRings rings;
  try {
    for (std::size_t at = head; at + record_head < bytes.size();) {
      add_record(bytes, at + record_head, rings);
      at += record_head + 2 * bytes.big_integer(at + 4); // in words of 16 bits
    }
  } catch (const std::out_of_range&) {
    return {{}, fmt::format("{} is damaged", path), ""};
  }
  const std::string stem = path.substr(0, path.size() - std::string_view(".shp").size());
  return rings.finish(path, read_text(stem + ".prj").value_or(read_text(stem + ".PRJ").value_or("")), lines);
}

} // namespace trime_check
