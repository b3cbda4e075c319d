// SPDX-License-Identifier: BSD-3-Clause
#include "projection/projection.hpp"

#include "core/angle.hpp"
#include "trime/core/error.hpp"

#include <proj.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace trime::projection {
namespace {

using geometry::Vec2;

struct Close {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
};
using Context = std::unique_ptr<PJ_CONTEXT, Close>;
using Object = std::unique_ptr<PJ, Close>;

/// Silent, and off the net: a grid that is fetched or not would change the mesh.
Context make_context() {
  Context context(proj_context_create());
  if (!context)
    throw ConfigError("PROJ cannot start; is the package proj-data installed?");
  proj_log_level(context.get(), PJ_LOG_NONE);
  proj_context_set_enable_network(context.get(), 0);
  return context;
}

std::string reason(const Context& context) {
  const int code = proj_context_errno(context.get());
  return code == 0 ? std::string("unknown name") : std::string(proj_context_errno_string(context.get(), code));
}

/// A projection without '+type=crs' is a reference system, too.
Object make_crs(const Context& context, const std::string& crs) {
  const bool lacks_type = crs.starts_with("+") && crs.find("+type=crs") == std::string::npos;
  Object object(proj_create(context.get(), lacks_type ? (crs + " +type=crs").c_str() : crs.c_str()));
  if (!object || proj_is_crs(object.get()) == 0)
    throw ConfigError(fmt::format("PROJ does not know the coordinate reference system '{}' ({}); expected one such as "
                                  "EPSG:32633, or '+proj=utm +zone=33 +datum=WGS84'",
                                  crs.size() > 60 ? crs.substr(0, 60) + "..." : crs, reason(context)));
  return object;
}

/// Without a shift to another datum around it.
Object make_plain_crs(const Context& context, const std::string& crs) {
  Object object = make_crs(context, crs);
  while (proj_get_type(object.get()) == PJ_TYPE_BOUND_CRS)
    object.reset(proj_get_source_crs(context.get(), object.get()));
  return object;
}

} // namespace

struct Transform::Handle {
  Context context;
  Object way;
};

Transform::Transform(const std::string& from, const std::string& to) : handle_(std::make_unique<Handle>()) {
  handle_->context = make_context();
  PJ_CONTEXT* context = handle_->context.get();
  const Object source = make_crs(handle_->context, from), target = make_crs(handle_->context, to);
  const Object plain(proj_create_crs_to_crs_from_pj(context, source.get(), target.get(), nullptr, nullptr));
  if (plain)
    handle_->way.reset(proj_normalize_for_visualization(context, plain.get()));
  if (!handle_->way)
    throw ConfigError(
        fmt::format("PROJ cannot convert coordinates from '{}' to '{}' ({})", from, to, reason(handle_->context)));
}

Transform::~Transform() = default;

namespace {
std::optional<Vec2> transformed(PJ* way, PJ_DIRECTION direction, Vec2 p) {
  const PJ_COORD to = proj_trans(way, direction, proj_coord(p.x, p.y, 0, HUGE_VAL));
  proj_errno_reset(way);
  if (!std::isfinite(to.xy.x) || !std::isfinite(to.xy.y))
    return std::nullopt;
  return Vec2{to.xy.x, to.xy.y};
}
} // namespace

std::optional<Vec2> Transform::apply(Vec2 p) const {
  return transformed(handle_->way.get(), PJ_FWD, p);
}

std::optional<Vec2> Transform::undo(Vec2 p) const {
  return transformed(handle_->way.get(), PJ_INV, p);
}

struct Distortion::Handle {
  Context context;
  Object plane;
};

Distortion::Distortion(const std::string& plane) : handle_(std::make_unique<Handle>()) {
  handle_->context = make_context();
  handle_->plane = make_plain_crs(handle_->context, plane);
}

Distortion::~Distortion() = default;

double Distortion::scale(Vec2 place) const {
  const PJ_FACTORS factors = proj_factors(handle_->plane.get(), proj_coord(place.x * degrees, place.y * degrees, 0, 0));
  const bool known = proj_errno_reset(handle_->plane.get()) == 0 && factors.tissot_semiminor > 0 &&
                     std::isfinite(factors.tissot_semimajor);
  if (!known)
    return 1;
  const double longest = factors.tissot_semimajor, shortest = factors.tissot_semiminor;
  return longest * shortest >= 1 ? longest : shortest;
}

bool is_geographic(const std::string& crs) {
  const Context context = make_context();
  const Object object = make_plain_crs(context, crs);
  const PJ_TYPE type = proj_get_type(object.get());
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

std::string well_known_text(const std::string& crs) {
  const Context context = make_context();
  const Object object = make_crs(context, crs);
  const char* text = proj_as_wkt(context.get(), object.get(), PJ_WKT2_2019, nullptr);
  return text == nullptr ? crs : text;
}

namespace {

/// The direction to a place on the Earth.
std::array<double, 3> direction_of(Vec2 p) {
  const SinCos east = sin_cos(p.x * degrees), north = sin_cos(p.y * degrees);
  return {north.cos * east.cos, north.cos * east.sin, north.sin};
}

/// Returns the least range of longitudes that holds all given ones: it begins after the largest gap. Both ends may lie
/// beyond 180 degrees.
std::array<double, 2> range_of(std::vector<double> longitudes) {
  for (double& east : longitudes)
    east -= 360 * std::floor((east + 180) / 360);
  const auto [least, most] = std::minmax_element(longitudes.begin(), longitudes.end());
  if (*most - *least <= 180)
    return {*least, *most};
  std::sort(longitudes.begin(), longitudes.end());
  double largest = longitudes.front() + 360 - longitudes.back();
  std::array<double, 2> range{longitudes.front(), longitudes.back()};
  for (std::size_t k = 1; k < longitudes.size(); ++k)
    if (const double gap = longitudes[k] - longitudes[k - 1]; gap > largest) {
      largest = gap;
      range = {longitudes[k], longitudes[k - 1] + 360};
    }
  return range;
}

/// The middle of the box around points in longitude and latitude. Points around a pole have it there.
Vec2 middle_of(std::span<const Vec2> points) {
  std::vector<double> longitudes;
  double south = 90, north = -90;
  for (const Vec2 p : points) {
    longitudes.push_back(p.x);
    south = std::fmin(south, p.y);
    north = std::fmax(north, p.y);
  }
  const auto [west, east] = range_of(std::move(longitudes));
  const double latitude = 0.5 * (south + north), longitude = 0.5 * (west + east);
  if (east - west > 180)
    return {0, latitude < 0 ? -90.0 : 90.0};
  return {longitude > 180 ? longitude - 360 : longitude, latitude};
}

} // namespace

std::string local_plane(std::span<const Vec2> degrees_east_north) {
  const Vec2 middle = middle_of(degrees_east_north);
  // To a hundredth of a degree: people can read it.
  const auto rounded = [](double angle) { return std::round(angle * 100) / 100 + 0.0; };
  const double east = rounded(middle.x), north = rounded(middle.y);
  const std::array<double, 3> center = direction_of({east, north});
  for (const Vec2 p : degrees_east_north) {
    const std::array<double, 3> d = direction_of(p);
    const double cosine = d[0] * center[0] + d[1] * center[1] + d[2] * center[2];
    if (!(cosine >= sin_cos(farthest_degrees * degrees).cos))
      throw GeometryError(fmt::format(
          "'projection = auto' needs a shape whose vertices are within {} degrees of the middle of its box, which is "
          "at "
          "longitude {} and latitude {}; found a vertex at ({}, {}); set a projection by its name, such as EPSG:32633",
          farthest_degrees, east, north, p.x, p.y));
  }
  return fmt::format("+proj=stere +lat_0={} +lon_0={} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs +type=crs",
                     north, east);
}

} // namespace trime::projection
