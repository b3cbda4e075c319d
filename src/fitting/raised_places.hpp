// SPDX-License-Identifier: BSD-3-Clause
// Chooses by how much the size is raised around edges that are shorter than the user allows.
#pragma once

#include "fitting/fit_options.hpp"
#include "geometry/short_edge.hpp"
#include "sites/stage.hpp"
#include "sizing/raised_size.hpp"

#include <span>
#include <vector>

namespace trime::fitting {

/// @brief Returns a larger size for the place of each edge, unless the size there was raised by as much as is allowed.
/// Local.
/// @param round how often the size was raised before: later steps are larger
/// @throws GeometryError if the size at a place is not positive and finite
std::vector<sizing::LeastSize> raised_around(std::span<const geometry::ShortEdge> edges, const sites::Stage& stage,
                                             const FitOptions& options, int round);

} // namespace trime::fitting
