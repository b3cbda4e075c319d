// SPDX-License-Identifier: BSD-3-Clause
// Finds the lines of a map that do not close a ring.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/vec2.hpp"

#include <string>
#include <vector>

namespace trime::contours {

/// The ends of a line and the box around all its vertices.
struct LineEnds {
  FilePoint first, last;
  geometry::Box box;
};

/// Lines that hang together and do not all close rings.
struct OpenGroup {
  std::size_t line;                  ///< index of the line with the end that a message names
  FilePoint end;                     ///< an end that no other line shares, or, with branches, where three lines meet
  std::vector<std::size_t> left_out; ///< indices of the lines that close no ring, ascending
  bool nearly_closed = false;        ///< the lines form a ring with a gap: probably it should be closed
  bool branches = false; ///< without the open lines, an odd number of lines meets somewhere: all lines are left out
};

/// @brief Returns the groups of lines in which an odd number of lines ends at some place, in the order of their first
/// lines. Lines with a free end are left out again and again. Cost: O(n log n).
std::vector<OpenGroup> open_groups(const std::vector<LineEnds>& lines);

/// Returns the fault for a group. @param where file and line of OpenGroup::end
Fault fault_of(const OpenGroup& group, const std::string& where);

} // namespace trime::contours
