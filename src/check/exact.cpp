// SPDX-License-Identifier: BSD-3-Clause
#include "exact.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace trime_check {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 cgal(Point p) {
  return {p.x, p.y};
}

/// Exponent of the last bit that is set; values of 0 have none.
int last_bit(double value) {
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(value), &exponent);
  const auto digits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  return exponent - 53 + std::countr_zero(digits);
}

} // namespace

bool is_left_turn(Point a, Point b, Point c) {
  return CGAL::orientation(cgal(a), cgal(b), cgal(c)) == CGAL::LEFT_TURN;
}

bool is_inside_circle(Point a, Point b, Point c, Point d) {
  return CGAL::side_of_oriented_circle(cgal(a), cgal(b), cgal(c), cgal(d)) == CGAL::ON_POSITIVE_SIDE;
}

bool is_obtuse(Point a, Point b, Point c) {
  const auto is_above_90 = [](Point at, Point from, Point to) {
    return CGAL::angle(cgal(from), cgal(at), cgal(to)) == CGAL::OBTUSE;
  };
  return is_above_90(a, b, c) || is_above_90(b, c, a) || is_above_90(c, a, b);
}

IntegerPlane::IntegerPlane(const Mesh& mesh) {
  bool first = true;
  const auto include = [&](double value) {
    if (value == 0)
      return;
    exponent_ = first ? last_bit(value) : std::min(exponent_, last_bit(value));
    first = false;
  };
  for (const Point p : mesh.points) {
    include(p.x);
    include(p.y);
  }
  include(mesh.periods.x);
  include(mesh.periods.y);
}

Integer IntegerPlane::integer(double value) const {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  const Integer digits = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  const int shift = exponent - 53 - exponent_;
  return value == 0 ? Integer(0) : shift >= 0 ? Integer(digits << shift) : Integer(digits / (Integer(1) << -shift));
}

Integer IntegerPlane::cross(Point u, Point v) const {
  return integer(u.x) * integer(v.y) - integer(u.y) * integer(v.x);
}

Integer IntegerPlane::twice_area(Point a, Point b, Point c) const {
  const Integer ax = integer(a.x), ay = integer(a.y);
  return (integer(b.x) - ax) * (integer(c.y) - ay) - (integer(b.y) - ay) * (integer(c.x) - ax);
}

double IntegerPlane::area(const Integer& twice) const {
  return std::ldexp(twice.convert_to<double>(), 2 * exponent_ - 1);
}

} // namespace trime_check
