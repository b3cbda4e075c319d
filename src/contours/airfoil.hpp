// SPDX-License-Identifier: BSD-3-Clause
// Recognises the coordinates of airfoils as collections of them have them, in the formats of Selig and of Lednicer.
#pragma once

#include "contours/contour_text.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// One ring around an airfoil, from the trailing edge along one side to the nose, and back along the other side.
struct Airfoil {
  std::vector<FilePoint> points;
  std::string name;   ///< the first line of the file; may be empty
  const char* format; ///< Selig or Lednicer
};

/// @brief Returns the ring of an airfoil, or nothing for any other text.
///
/// Selig: a line with a name, then pairs of numbers from the trailing edge around the nose and back, without blank
/// lines. Lednicer: an optional line with a name, a pair with the numbers of points of the upper and the lower side,
/// and both sides from the nose to the trailing edge. Cost: O(n).
std::optional<Airfoil> airfoil_of(std::string_view text);

} // namespace trime::contours
