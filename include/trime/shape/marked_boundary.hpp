// SPDX-License-Identifier: BSD-3-Clause
// A boundary with the markers that files give its segments. Plain data.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <cstdint>
#include <vector>

namespace trime::shape {

/// Pieces with a marker other than 0 form a separate part, after all others in Boundary::part_names. It is called
/// "NAME.MARKER", or "NAME.TEXT" where the file has a name for the marker. Where two such parts meet on one curve there
/// is a corner.
struct MarkedBoundary {
  geometry::Boundary boundary;
  std::vector<std::int32_t> part_markers; ///< for each of Boundary::part_names; 0: no marker
};

} // namespace trime::shape
