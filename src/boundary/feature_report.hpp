// SPDX-License-Identifier: BSD-3-Clause
// Collects the report about features of the boundary that are smaller than the triangles.
#pragma once

#include "polygon/polygon.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/boundary/features.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>

namespace trime::boundary {

/// @param limits places where the size was lowered below `asked`, the size asked for O(sites of the boundary + limits)
FeatureReport report_features(const polygon::BoundarySites& boundary, std::span<const sizing::SizeLimit> limits,
                              const sizing::SizeField& asked);

/// @brief Adds how much the changes from the given boundary to the meshed one removed from the shape and added to it.
/// @param dropped the loops that were left out finally
/// @param asked as above
/// Costs and errors as find_loop_fates.
void report_losses(const geometry::Boundary& given, const geometry::Boundary& meshed,
                   const polygon::Simplification& simplified, const polygon::DroppedLoops& dropped,
                   const sizing::SizeField& asked, const geometry::Lattice& lattice, FeatureReport& report);

} // namespace trime::boundary
