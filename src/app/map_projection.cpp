// SPDX-License-Identifier: BSD-3-Clause
#include "app/map_projection.hpp"

#include "projection/projection.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trime::app {
namespace {

using geometry::Vec2;
using shape::Contour;
using shape::ContourRing;

std::string system_of(const Contour& contour) {
  return contour.crs.empty() ? projection::lon_lat : contour.crs;
}

[[noreturn]] void refuse(const Contour& contour, const ContourRing& ring, std::size_t k, const std::string& why) {
  throw GeometryError(fmt::format("{}:{}: the vertex ({:.12g}, {:.12g}) cannot be projected: {}", contour.source,
                                  ring.lines[k], ring.points[k].x, ring.points[k].y, why));
}

/// Of a file in degrees.
void check_degrees(const Contour& contour) {
  for (const ContourRing& ring : contour.rings)
    for (std::size_t k = 0; k < ring.points.size(); ++k)
      if (std::fabs(ring.points[k].y) > 90 || std::fabs(ring.points[k].x) > 360)
        refuse(
            contour, ring, k,
            "expected longitude (-360 to 360) and latitude (-90 to 90) in degrees, in this order; without 'projection' "
            "in [shape] coordinates are taken as they are");
}

Vec2 projected(const projection::Transform& transform, const Contour& contour, const ContourRing& ring, std::size_t k) {
  const auto to = transform.apply(ring.points[k]);
  if (!to)
    refuse(contour, ring, k, "it lies where the projection is not defined; take another one");
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

/// What all contours agree on, or nothing.
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

/// A map that may be in degrees, though it does not say so; null: there is none.
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

/// Without a projection.
MapSystem as_it_is(const RunOptions& options, std::span<const Contour> contours, Log& log) {
  const std::string crs = common_system(contours);
  const bool moved =
      std::any_of(options.parts.begin(), options.parts.end(), [](const PartOptions& part) { return part.normalize; });
  if (const Contour* map = map_without_system(contours); map != nullptr && !moved)
    log.info("{} tells no reference system: if it has longitude and latitude, 'projection = auto' in [shape] meshes "
             "them in metres",
             map->source);
  if (crs.empty() || moved)
    return {};
  try {
    if (projection::is_geographic(crs))
      log.warning("the contours are in longitude and latitude, and degrees are meshed as if they were lengths; "
                  "'projection = auto' in [shape] meshes them in metres");
    return {crs, projection::well_known_text(crs), crs};
  } catch (const ConfigError& error) { // nobody has asked for it
    log.warning("the reference system of the contours is left out: {}", error.what());
    return {};
  }
}

} // namespace

void project_contour(Contour& contour, const std::string& plane) {
  const std::string system = system_of(contour);
  if (projection::is_geographic(system))
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
    for (const Contour& contour : contours)
      if (projection::is_geographic(system_of(contour)))
        check_degrees(contour);
    map.crs = options.projection == "auto" ? local_plane_of(contours) : options.projection;
    if (projection::is_geographic(map.crs))
      throw ConfigError("expected a plane, in metres or the like, found longitude and latitude");
    for (Contour& contour : contours)
      if (!contour.rings.empty()) {
        if (map.crs_of_files.empty())
          map.crs_of_files = system_of(contour);
        project_contour(contour, map.crs);
      }
    map.well_known_text = projection::well_known_text(map.crs);
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("'projection = {}' in [shape]: {}", options.projection, error.what()));
  }
  log.info("projection: {}", map.crs);
  return map;
}

} // namespace trime::app
