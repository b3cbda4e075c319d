// SPDX-License-Identifier: BSD-3-Clause
// Compares each loop of the shape with the edges of the mesh that follow it, and judges the difference by the loop's
// own area, width and extent: 0.1 % of a large domain may be more than a foil in it.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/boundary/features.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::boundary {

/// @brief Sets extent and reach of the fates of changed loops. O(n log n) for n pieces if a curve has changed,
/// otherwise O(n); uses all threads. Local.
/// @param fates one for each loop of `given`, as find_loop_fates returns them
void measure_reach(const geometry::Boundary& given, const geometry::Boundary& meshed, std::vector<LoopFate>& fates);

/// @brief Sets what the report says about areas and deviations of loops, for the edges of this polygon. It may be
/// called again for another polygon on the same curves. O(sites + pieces); uses all threads. Local.
/// @pre report_losses has made the fates of `report` for these curves; the loops of `polygon` are those of `meshed`
/// @throws GeometryError if the size `asked` is not positive and finite at the worst loop
void measure_bodies(const geometry::Boundary& meshed, const polygon::BoundarySites& polygon,
                    const sizing::SizeField& asked, FeatureReport& report);

/// Returns by how much a loop differs from the shape, divided by the difference from which the program warns.
double difference_of(const LoopFate& fate);

} // namespace trime::boundary
