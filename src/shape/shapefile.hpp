// SPDX-License-Identifier: BSD-3-Clause
// ESRI shapefiles, read by libshp.
#pragma once

#include "trime/shape/contour.hpp"

namespace trime::shape {

/// @brief Rings of the polygons of a shapefile, and of lines that end where they start. The number of a record, from 1,
/// stands for the line of its vertices. NAME.shx must lie beside it; NAME.prj tells the reference system.
/// @param hint ends the message if the file cannot be opened
/// @throws FileError if a file is missing or damaged; GeometryError `source:record: ...` for open lines, and for
/// shapes that are neither polygons nor lines
/// @note Serial.
Contour read_shapefile(const std::string& path, const std::string& hint);

} // namespace trime::shape
