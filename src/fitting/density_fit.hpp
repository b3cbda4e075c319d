// SPDX-License-Identifier: BSD-3-Clause
// Finds the factor of a size that differs from place to place.
#pragma once

#include "fitting/size_trials.hpp"

#include <variant>

namespace trime::fitting {

/// @brief Finds the layout of any size field with the largest number of points that is at most `points`. It uses the
/// integral of h^-2 over the shape outside the strip, and the actual number of boundary sites. If the options have an
/// edge length, it finds the factor with this mean edge length. Collective. O(cells of the integral): about 10 /
/// coarsening^2 per site and round, in 3 to 6 rounds.
/// @param coarsening factor on the width of the cells of the integral
/// @return TooFewPoints as in fit_lattice
/// @throws ConfigError as in fit_lattice; GeometryError if the size field is not positive and finite
std::variant<SizeTrial, TooFewPoints> fit_density(const LayoutContext& context, double points, double coarsening);

} // namespace trime::fitting
