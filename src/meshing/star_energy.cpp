// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/star_energy.hpp"

#include <cmath>

namespace trime::meshing {

using geometry::Vec2;

namespace {

constexpr double c = 0.28867513459481287; // 1 / (2 sqrt(3)): eta = c (a^2 + b^2 + c^2) / (2 area)

constexpr double weight_of_bad = 10; // of the fourth power

/// eta of the triangle p, a, b: (sum of squared edges) / (4 sqrt(3) area); negative if turned over.
double eta(Vec2 p, Vec2 a, Vec2 b) {
  const double sum =
      geometry::squared_length(p - a) + geometry::squared_length(p - b) + geometry::squared_length(a - b);
  return c * sum / geometry::cross(a - p, b - p);
}

double energy_of(double value) {
  const double excess = value - 1;
  return excess * excess * (1 + weight_of_bad * (excess * excess));
}

} // namespace

double star_energy(Vec2 p, std::span<const Vec2> ring, bool closed) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size() - !closed; ++k) {
    const double value = eta(p, ring[k], ring[k + 1 == ring.size() ? 0 : k + 1]);
    if (!(value >= 1 - 1e-9))
      return INFINITY;
    sum += energy_of(value);
  }
  return sum;
}

EnergyModel star_energy_model(Vec2 p, std::span<const Vec2> ring, bool closed) {
  EnergyModel model;
  for (std::size_t k = 0; k < ring.size() - !closed; ++k) {
    const Vec2 a = ring[k], b = ring[k + 1 == ring.size() ? 0 : k + 1];
    const double inverse = 1 / geometry::cross(a - p, b - p);
    const double sum =
        geometry::squared_length(p - a) + geometry::squared_length(p - b) + geometry::squared_length(a - b);
    const Vec2 of_sum = 2 * ((p - a) + (p - b)), of_area{a.y - b.y, b.x - a.x};
    const double value = c * sum * inverse, excess = value - 1;
    const Vec2 g = c * inverse * (of_sum - (sum * inverse) * of_area);
    const double w = c * inverse * inverse, v = 2 * sum * inverse;
    const double hxx = 4 * c * inverse + w * (v * of_area.x * of_area.x - 2 * of_sum.x * of_area.x);
    const double hyy = 4 * c * inverse + w * (v * of_area.y * of_area.y - 2 * of_sum.y * of_area.y);
    const double hxy = w * (v * of_area.x * of_area.y - of_sum.x * of_area.y - of_sum.y * of_area.x);
    const double square = weight_of_bad * (excess * excess);
    const double first = excess * (2 + 4 * square), second = 2 + 12 * square;
    model.value += energy_of(value);
    model.gradient = model.gradient + first * g;
    model.xx += second * g.x * g.x + first * hxx;
    model.xy += second * g.x * g.y + first * hxy;
    model.yy += second * g.y * g.y + first * hyy;
  }
  return model;
}

Vec2 newton_step(const EnergyModel& model, double limit) {
  const double determinant = model.xx * model.yy - model.xy * model.xy;
  Vec2 step;
  if (determinant > 1e-6 * (model.xx * model.xx + model.yy * model.yy) && model.xx > 0)
    step = (-1 / determinant) * Vec2{model.yy * model.gradient.x - model.xy * model.gradient.y,
                                     model.xx * model.gradient.y - model.xy * model.gradient.x};
  else
    step = -1e300 * model.gradient;
  const double length = geometry::length(step);
  if (!(length > limit))
    return step;
  const double steepness = geometry::length(model.gradient);
  if (!std::isfinite(length))
    return steepness > 0 ? (-limit / steepness) * model.gradient : Vec2{};
  return (limit / length) * step;
}

} // namespace trime::meshing
