// SPDX-License-Identifier: BSD-3-Clause
// What was done about features of the boundary that are smaller than the elements.
#pragma once

#include "polygon/polygon.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/boundary/feature_summary.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>

namespace trime::boundary {

/// @param limits places where the size was lowered below `asked`, the size that was asked for
/// O(sites of the boundary + limits)
FeatureReport report_features(const polygon::BoundarySites& boundary, std::span<const sizing::SizeLimit> limits,
                              const sizing::SizeField& asked);

} // namespace trime::boundary
