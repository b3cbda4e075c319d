// SPDX-License-Identifier: BSD-3-Clause
// Traced rings end where the container ends; in a periodic container they must fit together across its border.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/frame.hpp"
#include "trime/shape/part.hpp"

namespace trime::shape {

/// @brief The part within the container, its vertices on opposite periodic sides at exactly the same places.
///
/// Each vertex on a lower side and its partner across differ by what the tracing is off, far less than 1e-5 of the
/// container's longer side.
/// @throws GeometryError if a vertex has no partner: the function is not periodic
contours::Contour clip_to_periods(const Part& traced, const geometry::Frame& frame);

} // namespace trime::shape
