// SPDX-License-Identifier: BSD-3-Clause
// Reads ESRI shapefiles with libshp.
#pragma once

#include "trime/contours/contour.hpp"

namespace trime::contours {

/// @brief Returns the rings of the polygons of a shapefile, and of lines that form rings. The line number of a vertex
/// is the number of its record, from 1. NAME.shx must be next to it; NAME.prj names the reference system.
/// @param hint ends the message if the file cannot be opened
/// @param attribute of NAME.dbf that names the boundary, see parse_geojson; may be empty. Texts are UTF-8 or Latin-1
/// @throws FileError if a file is missing or damaged; ConfigError if there is no such attribute; GeometryError
/// `source:record: ...` for open lines
/// @note Serial.
Contour read_shapefile(const std::string& path, const std::string& hint, const std::string& attribute);

} // namespace trime::contours
