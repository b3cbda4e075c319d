// SPDX-License-Identifier: BSD-3-Clause
// Names vertices of contours in messages: by file and line, and in maps by the feature, since most programs write a map
// in one line.
#pragma once

#include "trime/contours/contour.hpp"

#include <string>
#include <string_view>

namespace trime::contours {

/// @brief Returns `map.geojson:12 (feature 3)` for the beginning of a message.
/// @param line 0 if the file has no lines; it is left out then
/// @param feature result of in_brackets; may be empty
std::string place_in_file(const std::string& source, int line, const std::string& feature = {});

/// @brief Returns place_in_file for a vertex of the contour. In a map the first line is left out.
std::string place_of_line(const Contour& contour, int line, const std::string& feature = {});

/// Returns ` (feature 3, 'Sylt')`, or an empty text if `number` is 0.
std::string in_brackets(int number, const std::string& name);

/// @brief Returns where a vertex of the contour stands in the file, for the beginning of a message: `coast.xy:12`, or
/// `map.geojson (feature 3, 'Sylt')`.
/// @param line one of ContourRing::lines
std::string where(const Contour& contour, int line);

/// Returns `line 12`, or `feature 3, 'Sylt'`.
std::string line_or_feature(const Contour& contour, int line);

/// Returns how well people recognise a feature by the attribute with this name: 0 for not at all.
int telling_rank(std::string_view attribute);

/// The rank of the attribute that the user has chosen for the names of boundaries, regions or curves: above ids, and
/// below names, since many features may have the same value.
constexpr int chosen_rank = 8;

} // namespace trime::contours
