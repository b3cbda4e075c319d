// SPDX-License-Identifier: BSD-3-Clause
#include "app/map_projection.hpp"

#include "contours/date_line.hpp"
#include "contours/map_features.hpp"
#include "core/quoted.hpp"
#include "projection/projection.hpp"
#include "projection/straight_edges.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trime::app {
namespace {

using contours::Contour;
using contours::ContourRing;
using geometry::Vec2;

std::string system_of(const Contour& contour) {
  return contour.crs.empty() ? projection::lon_lat : contour.crs;
}

[[noreturn]] void refuse(const Contour& contour, const ContourRing& ring, std::size_t k, const std::string& why) {
  throw GeometryError(fmt::format("{}: the vertex ({:.12g}, {:.12g}) cannot be projected: {}",
                                  contours::where(contour, ring.lines[k]), ring.points[k].x, ring.points[k].y, why));
}

/// Checks that coordinates in degrees lie on the Earth.
void check_degrees(const Contour& contour) {
  for (const ContourRing& ring : contour.rings)
    for (std::size_t k = 0; k < ring.points.size(); ++k)
      if (std::fabs(ring.points[k].y) > 90 || std::fabs(ring.points[k].x) > 360)
        refuse(contour, ring, k,
               "expected longitude (-360 to 360) and latitude (-90 to 90) in degrees, in this order; without "
               "'projection' in [shape] coordinates are used as they are");
}

Vec2 projected(const projection::Transform& transform, const Contour& contour, const ContourRing& ring, std::size_t k) {
  const auto to = transform.apply(ring.points[k]);
  if (!to)
    refuse(contour, ring, k, "the projection is not defined there; choose another one");
  return *to;
}

std::string local_plane_of(std::span<const Contour> contours) {
  std::vector<Vec2> places;
  for (const Contour& contour : contours) {
    if (contour.rings.empty())
      continue;
    const projection::Transform to_degrees(system_of(contour), projection::lon_lat);
    for (const ContourRing& ring : contour.rings)
      for (std::size_t k = 0; k < ring.points.size(); ++k)
        places.push_back(projected(to_degrees, contour, ring, k));
  }
  return projection::local_plane(places);
}

/// Returns the reference system that all contours agree on, or nothing.
std::string common_system(std::span<const Contour> contours) {
  const Contour* first = nullptr;
  for (const Contour& contour : contours)
    if (!contour.rings.empty()) {
      if (first != nullptr && contour.crs != first->crs)
        return {};
      first = &contour;
    }
  return first == nullptr ? std::string() : first->crs;
}

/// Returns a map that may be in degrees, though it does not say so, or null.
const Contour* map_without_system(std::span<const Contour> contours) {
  for (const Contour& contour : contours)
    if (contour.is_map && contour.crs.empty() &&
        std::all_of(contour.rings.begin(), contour.rings.end(), [](const ContourRing& ring) {
          return std::all_of(ring.points.begin(), ring.points.end(),
                             [](Vec2 p) { return std::fabs(p.x) <= 360 && std::fabs(p.y) <= 90; });
        }))
      return &contour;
  return nullptr;
}

geometry::Box box_of(std::span<const Contour> contours) {
  geometry::Box box;
  for (const Contour& contour : contours)
    for (const ContourRing& ring : contour.rings)
      for (const Vec2 p : ring.points)
        box.include(p);
  return box;
}

/// Does the map reach both sides of the date line, as one that is cut there?
bool is_cut_at_date_line(const geometry::Box& box) {
  return std::fabs(box.min.x + contours::date_line) <= contours::on_meridian &&
         std::fabs(box.max.x - contours::date_line) <= contours::on_meridian;
}

/// Degrees where metres were meant would lose nearly all of the shape: edges of metres are longer than all of it.
/// Returns whether there is a warning.
bool tell_of_degrees(const RunOptions& options, const Contour& map, const geometry::Box& box, Log& log) {
  constexpr double far = 4; // extents between the origin and the box: drawings begin near the origin
  const double extent = std::fmax(box.width(), box.height());
  const double away =
      std::hypot(std::fmax(std::fmax(box.min.x, -box.max.x), 0), std::fmax(std::fmax(box.min.y, -box.max.y), 0));
  const GivenLength given = length_of(options);
  if (given.length > extent)
    log.warning("{} = {:g} is longer than the whole shape ({:.3g}). The coordinates of {} are within 360 and 90, so "
                "they are most likely longitude and latitude in degrees, but the length seems to be in metres; set "
                "'projection = auto' in [shape] to mesh them in metres",
                given.key, given.length, extent, map.source);
  else if (is_cut_at_date_line(box))
    log.warning("the coordinates of {} are most likely longitude and latitude in degrees: the map begins at -180 and "
                "ends at 180; set 'projection = auto' in [shape] to mesh it in metres",
                map.source);
  else if (away > far * extent)
    log.warning("the coordinates of {} are most likely longitude and latitude in degrees: the map is {:.3g} long and "
                "{:.3g} away from (0, 0); set 'projection = auto' in [shape] to mesh them in metres",
                map.source, extent, away);
  else {
    log.summary("{} does not say in which reference system its coordinates are: if they are longitude and latitude, "
                "'projection = auto' in [shape] meshes them in metres",
                map.source);
    return false;
  }
  return true;
}

/// Where a projection stretches lengths most, among vertices far from each other in the file.
struct Stretch {
  double most = 1; ///< times too long, or too short below 1
  Vec2 place;      ///< longitude and latitude
};

Stretch stretch_of(std::span<const Contour> contours, const std::string& plane) {
  constexpr std::size_t enough = 200; // of a contour: the distortion is smooth, and a look takes some microseconds
  const projection::Distortion distortion(plane);
  Stretch worst;
  for (const Contour& contour : contours) {
    if (contour.rings.empty())
      continue;
    std::size_t vertices = 0, number = 0;
    for (const ContourRing& ring : contour.rings)
      vertices += ring.points.size();
    const std::size_t stride = vertices / enough + 1;
    const projection::Transform to_degrees(system_of(contour), projection::lon_lat);
    for (const ContourRing& ring : contour.rings)
      for (const Vec2 p : ring.in_file)
        if (const auto place = number++ % stride == 0 ? to_degrees.apply(p) : std::nullopt)
          if (const double scale = distortion.scale(*place);
              std::fabs(std::log(scale)) > std::fabs(std::log(worst.most)))
            worst = {scale, *place};
  }
  return worst;
}

/// Otherwise nobody would notice a zone next to the right one, or a system of another country. @pre the contours are
/// projected
void warn_of_distortion(std::span<const Contour> contours, const std::string& plane, Log& log) {
  constexpr double warned = 0.01; // 25 times what UTM has in its zone
  const Stretch worst = stretch_of(contours, plane);
  if (std::fabs(worst.most - 1) <= warned)
    return;
  const int zone = std::clamp(static_cast<int>(std::floor((worst.place.x + 180) / 6)) + 1, 1, 60);
  log.warning(
      "'projection = {}' stretches lengths by a factor of {:.3g} at longitude {:.6g}, latitude {:.6g}, since it is "
      "made for another place; use 'projection = auto', or EPSG:{} (UTM zone {}) for data near that place",
      plane, worst.most, worst.place.x, worst.place.y, (worst.place.y < 0 ? 32700 : 32600) + zone, zone);
}

void tell_of_divided(const projection::DividedEdges& divided, Log& log) {
  if (divided.edges > 0)
    log.info("{} long edge{} of the contours {} divided by {} more vertices: edges are straight in the coordinates of "
             "their files, and {} up to {:.3g} away from that line in the plane",
             divided.edges, divided.edges == 1 ? "" : "s", divided.edges == 1 ? "is" : "are", divided.vertices,
             divided.edges == 1 ? "this one was" : "these were", divided.deviation);
}

/// Joins polygons that their files cut at 180 degrees, and checks coordinates in degrees. @pre nothing is projected
void prepare_degrees(const RunOptions& options, std::span<Contour> contours, Log& log) {
  for (std::size_t k = 0; k < contours.size(); ++k) {
    Contour& contour = contours[k];
    if (!projection::is_geographic(system_of(contour)))
      continue;
    check_degrees(contour);
    const std::size_t first_region = options.parts.size() + options.curves.size();
    if (k >= options.parts.size() && k < first_region) // lines of curves, which are not joined
      continue;
    const bool united = k >= first_region || options.parts[k].dissolve;
    const double length =
        contours::join_at_date_line(contour, united ? contours::DateLine::each_separate : contours::DateLine::join);
    if (length > 0)
      log.info("{}: the polygons that meet at longitudes 180 and -180 are joined; they share {:.4g} degrees of this "
               "meridian",
               contour.source, length);
  }
}

/// Without a projection.
MapSystem as_it_is(const RunOptions& options, std::span<const Contour> contours, Log& log) {
  MapSystem found;
  const std::string crs = common_system(contours);
  const bool moved =
      std::any_of(options.parts.begin(), options.parts.end(), [](const PartOptions& part) { return part.normalize; });
  if (const Contour* map = map_without_system(contours); map != nullptr && !moved)
    found.may_be_degrees = tell_of_degrees(options, *map, box_of(contours), log);
  if (crs.empty() || moved)
    return found;
  try {
    found.may_be_degrees = projection::is_geographic(crs);
    if (found.may_be_degrees)
      log.warning("the contours are in longitude and latitude, and degrees are meshed as if they were lengths; "
                  "'projection = auto' in [shape] meshes them in metres");
    return {crs, projection::well_known_text(crs), crs, found.may_be_degrees};
  } catch (const ConfigError& error) { // nobody has asked for it
    log.warning("the mesh file does not name the reference system of the contours: {}", error.what());
    return found;
  }
}

} // namespace

GivenLength length_of(const RunOptions& options) {
  const meshing::MeshOptions& mesh = options.mesh;
  GivenLength least{"edge_length", mesh.edge_length.value_or(0)};
  if (mesh.absolute_sizes && options.sizing.type == "uniform")
    least = {"max_size", mesh.max_size.value_or(0)};
  for (const sizing::NamedSize& named : options.sizing.size_at)
    if (!(least.length > 0) || named.size < least.length)
      least = {"size_at", named.size};
  return mesh.min_size.value_or(0) > least.length ? GivenLength{"min_size", *mesh.min_size} : least;
}

void project_contour(Contour& contour, const std::string& plane) {
  const std::string system = system_of(contour);
  contour.in_degrees = projection::is_geographic(system);
  if (contour.in_degrees)
    check_degrees(contour);
  const projection::Transform transform(system, plane);
  for (ContourRing& ring : contour.rings) {
    std::vector<Vec2> points;
    points.reserve(ring.points.size());
    for (std::size_t k = 0; k < ring.points.size(); ++k)
      points.push_back(projected(transform, contour, ring, k));
    ring.in_file = std::exchange(ring.points, std::move(points));
  }
}

MapSystem project_contours(const RunOptions& options, std::span<Contour> contours, Log& log) {
  if (options.projection.empty())
    return as_it_is(options, contours, log);
  MapSystem map;
  try {
    prepare_degrees(options, contours, log);
    map.crs = options.projection == "auto" ? local_plane_of(contours) : options.projection;
    if (projection::is_geographic(map.crs))
      throw ConfigError(
          "expected a system with coordinates in metres or the like, found one in longitude and latitude");
    for (Contour& contour : contours)
      if (!contour.rings.empty()) {
        if (map.crs_of_files.empty())
          map.crs_of_files = system_of(contour);
        project_contour(contour, map.crs);
      }
    map.well_known_text = projection::well_known_text(map.crs);
    tell_of_divided(projection::divide_long_edges(contours, map.crs), log);
    if (options.projection != "auto")
      warn_of_distortion(contours, map.crs, log);
  } catch (const ConfigError& error) {
    throw ConfigError(
        fmt::format("'projection = {}' in [shape]: {}", shown(options.projection), without_middle(error.what())));
  }
  log.info("projection: {}", map.crs);
  return map;
}

std::string name_of(const MapSystem& map) {
  const std::size_t bracket = map.crs.find('['), quote = map.crs.find('"'), end = map.crs.find('"', quote + 1);
  if (bracket == std::string::npos || quote != bracket + 1 || end == std::string::npos)
    return map.crs;
  return map.crs.substr(quote + 1, end - quote - 1);
}

std::optional<Vec2> on_earth(const MapSystem& map, Vec2 place) {
  if (map.crs.empty() || projection::is_geographic(map.crs))
    return std::nullopt;
  try {
    return projection::Transform(projection::lon_lat, map.crs).undo(place);
  } catch (const ConfigError&) { // a local grid, which lies nowhere on the Earth
    return std::nullopt;
  }
}

} // namespace trime::app
