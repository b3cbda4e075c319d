// SPDX-License-Identifier: BSD-3-Clause
// Finds the factor of a size field whose values differ from place to place.
#pragma once

#include "fitting/size_trials.hpp"

#include <variant>

namespace trime::fitting {

/// @brief Finds the layout with the largest number of points that is at most `points`, for any size field. It adds the
/// integral of h^-2 over the shape outside the strip to the number of sites that the laid boundary has. If the options
/// set an edge length, it finds the factor at which the mean length of the edges equals it. Collective. Cost: O(cells
/// of the integral), about 10 / coarsening^2 cells for each site in each of 3 to 6 rounds.
/// @param begin a fit for about this number of points, from which the search begins; null: it begins from an estimate
/// @param coarsening factor on the width of the cells of the integral
/// @return TooFewPoints in the same cases as fit_lattice
/// @throws ConfigError in the same cases as fit_lattice; GeometryError if the size field is not positive and finite
std::variant<SizeTrial, TooFewPoints> fit_density(const LayoutContext& context, const FittedSize* begin, double points,
                                                  double coarsening);

} // namespace trime::fitting
