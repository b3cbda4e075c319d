// SPDX-License-Identifier: BSD-3-Clause
// Moves towards equilateral triangles.
#include "trime/meshing/update_rule.hpp"

#include <algorithm>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double root_3 = 1.7320508075688772;

/// Gradient and matrix of second derivatives of an energy with respect to the place of one site.
class LocalEnergy {
public:
  /// Adds the triangle (site, site + u, site + v). @pre counter-clockwise, not flat
  void add(Vec2 u, Vec2 v, double wanted_area, double stiffness) {
    const Vec2 opposite = v - u, of_area{-0.5 * opposite.y, 0.5 * opposite.x}, of_squares = -2.0 * (u + v);
    const double area = 0.5 * geometry::cross(u, v), inverse = 1 / area, unit = inverse / (4 * root_3);
    const double squares =
        geometry::squared_length(u) + geometry::squared_length(v) + geometry::squared_length(opposite);
    const double shape = squares * unit, ratio = wanted_area * inverse;
    gradient_ =
        gradient_ + unit * of_squares + (stiffness / wanted_area * (1 - ratio * ratio) - shape * inverse) * of_area;
    xx_ += 4 * unit;
    yy_ += 4 * unit;
    add_product(-2 * unit * inverse, of_squares, of_area);
    add_product(2 * (shape + stiffness * ratio) * inverse * inverse, of_area, of_area);
  }

  /// To the minimum of the quadratic model; zero where there is none.
  Vec2 newton_step() const {
    const double determinant = xx_ * yy_ - xy_ * xy_;
    if (!(determinant > 0))
      return {};
    const Vec2 g = gradient_;
    return (-1 / determinant) * Vec2{yy_ * g.x - xy_ * g.y, xx_ * g.y - xy_ * g.x};
  }

private:
  /// Symmetric part of the product of two gradients.
  void add_product(double factor, Vec2 a, Vec2 b) {
    xx_ += factor * a.x * b.x;
    xy_ += 0.5 * factor * (a.x * b.y + a.y * b.x);
    yy_ += factor * a.y * b.y;
  }

  Vec2 gradient_;
  double xx_ = 0, xy_ = 0, yy_ = 0;
};

} // namespace

void TriangleRule::begin_sweep(const SweepSums& sums) {
  const double sizes = sums.squared_size_ratio.value(), lengths = sums.squared_length_ratio.value();
  area_scale_ = sizes > 0 && lengths > 0 ? lengths / sizes : 1;
  momentum_.begin_sweep(sums);
}

Step TriangleRule::step(const StarView& view, LocalIndex i) const {
  const std::span<const LocalIndex> ring = view.stars.ring(i);
  const std::size_t n = ring.size();
  if (n < 3 || std::find(ring.begin(), ring.end(), delaunay::gap) != ring.end())
    return {};
  const Vec2 p = view.points.position(i);
  const double own = view.size(i);
  LocalEnergy energy;
  for (std::size_t k = 0; k < n; ++k) {
    const LocalIndex a = ring[k], b = ring[k + 1 == n ? 0 : k + 1];
    const double h = (own + view.size(a) + view.size(b)) / 3;
    energy.add(view.points.position(a) - p, view.points.position(b) - p, 0.25 * root_3 * area_scale_ * h * h,
               stiffness);
  }
  return momentum_.step(view, i, damping * energy.newton_step());
}

} // namespace trime::meshing
