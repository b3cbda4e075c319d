// SPDX-License-Identifier: BSD-3-Clause
// The energy that the moves of the clean-up lower: how far the triangles around a vertex are from equilateral ones.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <span>

namespace trime::cleanup {

/// @brief Sum of e^2 + w e^4, e = eta - 1, w = CleanupRules::quartic_weight, over the triangles (p, ring[k],
/// ring[k+1]), eta = (a^2 + b^2 + c^2) / (4 sqrt(3) area) of the edges a, b, c: 1 for an equilateral triangle (Bank and
/// Smith 1997), smooth, without a scale. The square counts for the mean, the fourth power makes the worst triangle
/// rule. Infinity if a triangle is turned over or flat, or once the sum comes up to `limit`.
/// @param closed the ring is closed; else it is the open fan of a vertex on the boundary
double star_energy(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed, double limit = INFINITY);

/// Returns the energy with its derivatives by p. @pre no triangle is turned over or flat
struct EnergyModel {
  double value = 0;
  geometry::Vec2 gradient;
  double xx = 0, xy = 0, yy = 0;
};
EnergyModel star_energy_model(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed);

/// Newton's step where the model is convex, else down the gradient; not longer than `limit`.
geometry::Vec2 newton_step(const EnergyModel& model, double limit);

} // namespace trime::cleanup
