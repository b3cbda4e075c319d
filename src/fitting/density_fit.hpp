// SPDX-License-Identifier: BSD-3-Clause
// Finds the factor of a size that differs from place to place.
#pragma once

#include "fitting/size_trials.hpp"

#include <variant>

namespace trime::fitting {

/// @brief Finds the layout of any size field at the largest number of points that is not above `points`, from the
/// integral of h^-2 over the shape outside the strip and the sites that the boundary really takes. With an edge length
/// in the options, it finds the factor whose mean edge has it. Collective. O(cells of the integral), about 10 /
/// coarsening^2 a site and round, 3 to 6 rounds.
/// @param begin a fit for about this number of points, where the search begins; null: it begins at an estimate
/// @param coarsening of the integral
/// @return too few points as fit_lattice
/// @throws ConfigError as fit_lattice; GeometryError if the size field is not positive and finite
std::variant<SizeTrial, TooFewPoints> fit_density(const LayoutContext& context, const FittedSize* begin, double points,
                                                  double coarsening);

} // namespace trime::fitting
