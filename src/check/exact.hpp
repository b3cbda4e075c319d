// SPDX-License-Identifier: BSD-3-Clause
// Exact arithmetic of other libraries: predicates of CGAL, integers of Boost.
#pragma once

#include "mesh.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <vector>

namespace trime_check {

/// Is a, b, c a left turn? Exact.
bool is_left_turn(Point a, Point b, Point c);
/// Does d lie inside the circle through a, b, c, a left turn? On the circle is outside. Exact.
bool is_inside_circle(Point a, Point b, Point c, Point d);

using Integer = boost::multiprecision::cpp_int;

/// @brief Coordinates as integers: multiples of the largest common power of two.
class IntegerPlane {
public:
  /// @pre all are finite
  explicit IntegerPlane(const Mesh& mesh);
  /// Twice the signed area of the triangle a, b, c, in squared units. Exact.
  Integer twice_area(Point a, Point b, Point c) const;
  Integer cross(Point u, Point v) const;
  /// An area in the units of the file.
  double area(const Integer& twice) const;

private:
  Integer integer(double value) const;

  int exponent_ = 0; // the unit is 2^exponent_
};

} // namespace trime_check
