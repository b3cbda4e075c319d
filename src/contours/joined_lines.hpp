// SPDX-License-Identifier: BSD-3-Clause
// Joins lines of a map that end where other lines end to rings.
#pragma once

#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"

#include <string>
#include <vector>

namespace trime::contours {

/// A line of a map that does not end where it starts. It has two or more vertices.
struct OpenLine {
  std::vector<FilePoint> vertices;
  int feature = 0; ///< number of the feature; 0 if the line has no feature
  int marker = 0;
  std::string label = {}; ///< the feature in messages, see in_brackets
};

/// @brief Leaves out lines with the same vertices as an earlier line, in the same or in the opposite order, with a
/// warning for each of them. Cost: O(n log n).
void drop_repeated_lines(std::vector<OpenLine>& lines, Contour& contour);

/// @brief Joins lines that a map cuts at 180 degrees of longitude: an end at -180 moves to 180 if one line ends at each
/// of the two places and the next vertex of the moved end is within 90 degrees. Longitudes within 1e-9 degrees of the
/// meridian lie on it. Sets Contour::joins_date_line if a line has changed. Cost: O(n log n).
void join_ends_at_date_line(std::vector<OpenLine>& lines, Contour& contour);

/// @brief Joins lines to rings. At a place where more than two lines end, rings are closed as soon as possible. The
/// lines of a RingVertex are numbers of features, or of lines for a line without a feature.
///
/// If no edge occurs twice, no ring visits a vertex twice, see rings_of_segments. Otherwise a ring keeps edges on which
/// its lines run back and forth, for repair_ring.
/// @pre an even number of lines ends at each place
std::vector<std::vector<RingVertex>> rings_of_lines(const std::vector<OpenLine>& lines, Contour& contour);

} // namespace trime::contours
