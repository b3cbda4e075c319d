// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/star_energy.hpp"

#include "cleanup/rules.hpp"
#include "core/angle.hpp"

#include <cmath>

namespace trime::cleanup {

using geometry::Vec2;

namespace {

constexpr double c = 0.28867513459481287; // 1 / (2 sqrt(3)): eta = c (sum of squared edges) / (2 area)

/// row_height is the sine of 60 degrees.
Vec2 turned_by_60(Vec2 v) {
  return {0.5 * v.x - row_height * v.y, row_height * v.x + 0.5 * v.y};
}

double energy_of(double excess) {
  return excess * excess * (1 + CleanupRules::quartic_weight * (excess * excess));
}

} // namespace

// A triangle has its corners at p, p + u and p + v. With w = u turned by 60 degrees - v, the sum of its squared edges
// is 2 w.w + 2 sqrt(3) (u x v), so that eta - 1 = 2 c w.w / (u x v): nothing cancels, however good the triangle is.

double star_energy(Vec2 p, std::span<const Vec2> ring, bool closed, double limit) {
  double sum = 0;
  Vec2 u = (closed ? ring.back() : ring.front()) - p;
  for (std::size_t k = !closed; k < ring.size(); ++k) {
    const Vec2 v = ring[k] - p;
    const double area = geometry::cross(u, v);
    if (!(area > 0))
      return INFINITY;
    sum += energy_of(2 * c * geometry::squared_length(turned_by_60(u) - v) / area);
    if (!(sum < limit))
      return INFINITY;
    u = v;
  }
  return sum;
}

EnergyModel star_energy_model(Vec2 p, std::span<const Vec2> ring, bool closed) {
  EnergyModel model;
  Vec2 u = (closed ? ring.back() : ring.front()) - p;
  for (std::size_t k = !closed; k < ring.size(); ++k) {
    const Vec2 v = ring[k] - p, w = turned_by_60(u) - v;
    const double inverse = 1 / geometry::cross(u, v), scale = 2 * c * inverse;
    const double excess = scale * geometry::squared_length(w);
    const Vec2 of_square = 2 * turned_by_60(w), of_area = inverse * Vec2{u.y - v.y, v.x - u.x}; // relative to the area
    const Vec2 g = scale * of_square - excess * of_area;
    const double hxx = 2 * (scale - g.x * of_area.x);
    const double hyy = 2 * (scale - g.y * of_area.y);
    const double hxy = -(g.x * of_area.y + g.y * of_area.x);
    const double square = CleanupRules::quartic_weight * (excess * excess);
    const double first = excess * (2 + 4 * square), second = 2 + 12 * square;
    model.value += energy_of(excess);
    model.gradient = model.gradient + first * g;
    model.xx += second * g.x * g.x + first * hxx;
    model.xy += second * g.x * g.y + first * hxy;
    model.yy += second * g.y * g.y + first * hyy;
    u = v;
  }
  return model;
}

Vec2 newton_step(const EnergyModel& model, double limit) {
  const double determinant = model.xx * model.yy - model.xy * model.xy;
  Vec2 step;
  if (determinant > CleanupRules::least_convexity * (model.xx * model.xx + model.yy * model.yy) && model.xx > 0)
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

} // namespace trime::cleanup
