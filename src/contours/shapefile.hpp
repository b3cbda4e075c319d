// SPDX-License-Identifier: BSD-3-Clause
// ESRI shapefiles, read by libshp.
#pragma once

#include "trime/contours/contour.hpp"

namespace trime::contours {

/// @brief Rings of the polygons of a shapefile, and of lines that close rings. The number of a record, from 1, stands
/// for the line of its vertices. NAME.shx must be next to it; NAME.prj names the reference system.
/// @param hint ends the message if the file cannot be opened
/// @param attribute of NAME.dbf that names the boundary, see parse_geojson; empty: none. Texts are UTF-8 or Latin-1
/// @throws FileError if a file is missing or damaged; ConfigError if there is no such attribute; GeometryError
/// `source:record: ...` for open lines
/// @note Serial.
Contour read_shapefile(const std::string& path, const std::string& hint, const std::string& attribute);

} // namespace trime::contours
