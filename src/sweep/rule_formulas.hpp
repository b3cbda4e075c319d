// SPDX-License-Identifier: BSD-3-Clause
// The update rules as formulas over the neighbours of one site, or of several sites at once. The type V is double or a
// vector of doubles (core/lanes.hpp), so scalar code and vector code move every site to bit-identical places.
//
// A formula takes the triangles (site, a, b) of a star one after the other, counter-clockwise around the site. `active`
// is false in the vector lanes of sites whose triangles have all been taken.
#pragma once

#include "core/angle.hpp"
#include "core/lanes.hpp"
#include "sites/site_state.hpp"
#include "sweep/rules.hpp"

namespace trime::sweep {

/// The kind of update rule: repulsive bars (DistMesh), centroids of Voronoi cells (Lloyd), or an energy of the
/// triangles.
enum class Mover { bars, cells, triangles };

struct RuleParameters {
  Mover mover = Mover::bars;                   ///< for bars: rest length of a bar over h
  double length_scale = 1;                     ///< for triangles: wanted area over sqrt(3)/4 h^2
  double area_scale = 1;                       ///< for cells: exponent of 1/h in the weight
  int exponent = SweepRules::density_exponent; ///< share of the last move that is added to the next one (the lead)
  double momentum = 0;                         ///< share of the last move that becomes the lead
};

/// The vector from a site to one of its neighbours.
template <class V>
struct Spoke {
  V x, y;
  V squared; ///< squared distance of the neighbour from the site
  V size;    ///< target edge length h at the neighbour
};

template <class V>
struct Move {
  V x, y;
};

/// Returns alpha - 1 of the triangle (0, a, b), where alpha is R/(2r). For side lengths a, b, c and area A, this is a b
/// c (a + b + c) / (16 A^2) - 1.
template <class V>
TRIME_INLINE V excess_of_alpha(const Spoke<V>& a, const Spoke<V>& b, V twice_area) {
  const V x = b.x - a.x, y = b.y - a.y;
  const V first = lanes::square_root(a.squared), second = lanes::square_root(b.squared);
  const V third = lanes::square_root(x * x + y * y);
  return first * second * third * (first + second + third) / (4.0 * (twice_area * twice_area)) - 1.0;
}

/// Sums the forces of DistMeshRule.
template <class V, bool graded>
class BarFormula {
public:
  TRIME_INLINE BarFormula(const RuleParameters& rule, V own_size)
      : own_size_(own_size), half_scale_(rule.length_scale * 0.5), uniform_rest_(rule.length_scale * own_size) {}

  template <class M>
  TRIME_INLINE void add(const Spoke<V>& a, const Spoke<V>&, V, M active) {
    const V rest = graded ? half_scale_ * (own_size_ + a.size) : uniform_rest_;
    const V actual = lanes::square_root(a.squared), excess = rest / actual - 1.0;
    const auto pushes = active & (actual < rest);
    x_ = lanes::select(pushes, x_ - excess * a.x, x_);
    y_ = lanes::select(pushes, y_ - excess * a.y, y_);
  }
  TRIME_INLINE Move<V> move() const { return {SweepRules::bar_time_step * x_, SweepRules::bar_time_step * y_}; }

private:
  V own_size_;
  double half_scale_;
  V uniform_rest_;
  V x_{}, y_{};
};

/// Computes the centroid of a Voronoi cell, as CvdRule describes.
template <class V, bool graded>
class CellFormula {
public:
  TRIME_INLINE CellFormula(const RuleParameters& rule, V own_size)
      : own_size_(own_size), exponent_(graded ? rule.exponent : 0) {}

  template <class M>
  TRIME_INLINE void add(const Spoke<V>& a, const Spoke<V>& b, V twice_area, M active) {
    const V inverse = 0.5 / twice_area;
    const Corner corner{(a.squared * b.y - b.squared * a.y) * inverse, (b.squared * a.x - a.squared * b.x) * inverse,
                        graded ? weight(a.size, b.size) : V{} + 1.0};
    if (begun_)
      add_triangle(last_, corner, active);
    else
      first_ = last_ = corner;
    begun_ = true;
    last_.x = lanes::select(active, corner.x, last_.x);
    last_.y = lanes::select(active, corner.y, last_.y);
    last_.weight = lanes::select(active, corner.weight, last_.weight);
  }
  TRIME_INLINE Move<V> move() {
    add_triangle(last_, first_, own_size_ > 0); // always true: closes the cell
    const V inverse = 1.0 / mass_;
    const auto sound = mass_ > 0;
    return {lanes::select(sound, inverse * x_, V{}), lanes::select(sound, inverse * y_, V{})};
  }

private:
  struct Corner {
    V x, y, weight;
  };

  TRIME_INLINE V weight(V a, V b) const {
    const V ratio = 3.0 * own_size_ / (own_size_ + a + b);
    V result = V{} + 1.0;
    if (exponent_ == 4) // the usual exponent
      return (ratio * ratio) * (ratio * ratio);
    for (int k = 0; k < exponent_; ++k)
      result = result * ratio;
    return result;
  }

  /// Adds the integrals of a linear weight, and of the weight times the place, over the triangle (site, a, b). The
  /// weight is 1 at the site, and given at a and b.
  template <class M>
  TRIME_INLINE void add_triangle(const Corner& a, const Corner& b, M active) {
    const V twice_area = a.x * b.y - a.y * b.x;
    const V all = 1.0 + a.weight + b.weight, share = twice_area * (1.0 / 24);
    const V of_a = share * (all + a.weight), of_b = share * (all + b.weight);
    mass_ = lanes::select(active, mass_ + twice_area * all * (1.0 / 6), mass_);
    x_ = lanes::select(active, x_ + (of_a * a.x + of_b * b.x), x_);
    y_ = lanes::select(active, y_ + (of_a * a.y + of_b * b.y), y_);
  }

  V own_size_;
  int exponent_;
  bool begun_ = false;
  Corner first_{}, last_{};
  V mass_{}, x_{}, y_{};
};

/// Computes the Newton step of TriangleRule.
template <class V, bool graded>
class TriangleFormula {
public:
  TRIME_INLINE TriangleFormula(const RuleParameters& rule, V own_size)
      : own_size_(own_size), wanted_scale_(0.25 * sqrt_3 * rule.area_scale),
        uniform_wanted_(wanted_scale_ * own_size * own_size) {}

  /// Adds the gradient and the second derivatives of the energy of the triangle (site, a, b), as a function of the
  /// place of the site.
  template <class M>
  TRIME_INLINE void add(const Spoke<V>& a, const Spoke<V>& b, V twice_area, M active) {
    V wanted = uniform_wanted_;
    if constexpr (graded) {
      const V h = (own_size_ + a.size + b.size) * (1.0 / 3);
      wanted = wanted_scale_ * h * h;
    }
    const V opposite_x = b.x - a.x, opposite_y = b.y - a.y;
    const V area_x = -0.5 * opposite_y, area_y = 0.5 * opposite_x;          // gradient of the area
    const V squares_x = -2.0 * (a.x + b.x), squares_y = -2.0 * (a.y + b.y); // gradient of the sum of squared sides
    const V inverse = 2.0 / twice_area, unit = inverse * (1 / (4 * sqrt_3));
    const V squares = a.squared + b.squared + (opposite_x * opposite_x + opposite_y * opposite_y);
    const V shape = squares * unit, ratio = wanted * inverse;
    const V by_area = SweepRules::triangle_stiffness * (1.0 - ratio * ratio) / wanted - shape * inverse;
    const V mixed = -2.0 * unit * inverse,
            curved = 2.0 * (shape + SweepRules::triangle_stiffness * ratio) * inverse * inverse;
    gradient_x_ = lanes::select(active, gradient_x_ + (unit * squares_x + by_area * area_x), gradient_x_);
    gradient_y_ = lanes::select(active, gradient_y_ + (unit * squares_y + by_area * area_y), gradient_y_);
    xx_ = lanes::select(active, xx_ + (4.0 * unit + mixed * squares_x * area_x + curved * area_x * area_x), xx_);
    yy_ = lanes::select(active, yy_ + (4.0 * unit + mixed * squares_y * area_y + curved * area_y * area_y), yy_);
    xy_ = lanes::select(
        active, xy_ + (0.5 * mixed * (squares_x * area_y + squares_y * area_x) + curved * area_x * area_y), xy_);
  }
  /// Returns the damped Newton step to the minimum of the quadratic model of the energy; zero if the model has no
  /// minimum.
  TRIME_INLINE Move<V> move() const {
    const V determinant = xx_ * yy_ - xy_ * xy_, factor = -SweepRules::triangle_damping / determinant;
    const auto sound = determinant > 0;
    return {lanes::select(sound, factor * (yy_ * gradient_x_ - xy_ * gradient_y_), V{}),
            lanes::select(sound, factor * (xx_ * gradient_y_ - xy_ * gradient_x_), V{})};
  }

private:
  V own_size_;
  double wanted_scale_;
  V uniform_wanted_;
  V gradient_x_{}, gradient_y_{}, xx_{}, xy_{}, yy_{};
};

/// Returns the vector from a site at p to one of its neighbours.
inline Spoke<double> spoke_to(const sites::StarView& view, geometry::Vec2 p, LocalIndex neighbour) {
  const geometry::Vec2 u = view.points.position(neighbour) - p;
  return {u.x, u.y, u.x * u.x + u.y * u.y, view.size(neighbour)};
}

} // namespace trime::sweep
