// SPDX-License-Identifier: BSD-3-Clause
// Joins the polygons of maps that are cut at 180 degrees of longitude, as RFC 7946 demands of GeoJSON.
#pragma once

#include "trime/contours/contour.hpp"

namespace trime::contours {

/// [degrees] Longitude at which maps are cut, and a distance within which a longitude is this one: 0.1 mm.
inline constexpr double date_line = 180, on_meridian = 1e-9;

/// Which rings join_at_date_line may join.
enum class DateLine {
  join,          ///< all rings of the contour
  each_separate, ///< the rings of each polygon; polygons that share edges will be united later
};

/// @brief Joins polygons that meet at the date line: at longitude 180 on one side, at -180 on the other.
///
/// Where an edge at 180 and an edge at -180 cover the same latitudes, both are removed. Rings with edges at these
/// longitudes get 180 in place of -180, and the edges that are left form new rings, which follow all other rings and
/// keep the markers. Longitudes within 1e-9 degrees of the meridian lie on it. A contour where nothing
/// coincides is not changed. Cost: O(n log n) for n vertices, and O(m^2) at most for m edges along the meridian.
/// @param contour its coordinates are longitude and latitude in degrees, between -360 and 360
/// @return the length of the meridian, in degrees, on which polygons meet from both sides
/// @throws GeometryError if an odd number of edges meets at a vertex, which happens only if polygons overlap there
/// @note Serial.
double join_at_date_line(Contour& contour, DateLine treatment);

} // namespace trime::contours
