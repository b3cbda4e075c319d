// SPDX-License-Identifier: BSD-3-Clause
// Divides long edges of maps, so that in the plane they follow the lines that are straight in the coordinates of the
// file, for example in longitude and latitude.
#pragma once

#include "trime/contours/contour.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace trime::projection {

/// Counts the edges that were divided.
struct DividedEdges {
  std::size_t edges = 0;    ///< number of edges that received vertices
  std::size_t vertices = 0; ///< number of vertices that they received
  double deviation = 0;     ///< [plane] largest distance of an undivided edge from its line
};

/// @brief Divides the edges of projected contours that deviate by more than 1e-6 of the longer side of all contours
/// from the line that is straight in the coordinates of the file.
///
/// Vertices of the files stay. Edges with equal ends are divided in the same way, whatever their direction and file. A
/// vertex of any contour on a long edge becomes a vertex of this edge, so that two maps that share a part of a long
/// edge share the vertices on it. An edge gets at most 4095 vertices between two of the files. Contours whose edges are
/// short enough are not changed. An edge whose ends differ by more than 270 and less than 360 degrees in longitude is
/// taken across the date line.
/// Cost: O(n log n) for n vertices, and a few microseconds for each edge that is not obviously short.
/// @param plane name of the reference system of the plane
/// @pre each contour has rings with ContourRing::in_file, or no rings
/// @throws ConfigError if PROJ cannot convert from the system of a contour
/// @note Serial.
DividedEdges divide_long_edges(std::span<contours::Contour> contours, const std::string& plane);

} // namespace trime::projection
