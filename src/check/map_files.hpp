// SPDX-License-Identifier: BSD-3-Clause
// Reads the rings of maps: GeoJSON and ESRI shapefiles.
#pragma once

#include "contour_files.hpp"

#include <string>

namespace trime_check {

/// Polygons, closed lines, and lines that form rings together. Points are left out, as the mesher does.
ContourRings read_geojson(const std::string& path, const std::string& text, OpenLines lines);
/// Reads polygons and lines from the bytes of NAME.shp; the reference system comes from NAME.prj, if it exists.
ContourRings read_shapefile(const std::string& path, const std::string& bytes, OpenLines lines);

} // namespace trime_check
