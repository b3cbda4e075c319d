// SPDX-License-Identifier: BSD-3-Clause
// Makes the report about features of the boundary that are smaller than the triangles.
#pragma once

#include "polygon/polygon.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/boundary/features.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>

namespace trime::boundary {

/// Makes the report of the last stage.
/// @param limits places where the size was lowered
/// @param asked the size before it was lowered
/// Cost: O(sites of the boundary + limits).
FeatureReport report_features(const polygon::BoundarySites& boundary, std::span<const sizing::SizeLimit> limits,
                              const sizing::SizeField& asked);

/// @brief Adds to the report how much of the shape was removed, and how much was added, when the given boundary was
/// replaced by the meshed one.
/// @param dropped loops that were left out at the end
/// @param asked the size before it was lowered
/// Costs and errors are those of find_loop_fates.
void report_losses(const geometry::Boundary& given, const geometry::Boundary& meshed,
                   const polygon::Simplification& simplified, const polygon::DroppedLoops& dropped,
                   const sizing::SizeField& asked, const geometry::Lattice& lattice, FeatureReport& report);

} // namespace trime::boundary
