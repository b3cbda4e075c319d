// SPDX-License-Identifier: BSD-3-Clause
// Exact arithmetic by other libraries: predicates of CGAL and integers of Boost.
#pragma once

#include "mesh.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <vector>

namespace trime_check {

/// Returns whether the path from a over b to c turns left. Exact.
bool is_left_turn(Point a, Point b, Point c);
/// Returns whether d lies inside the circle through a, b, c; false if d lies on the circle. Exact. @pre the path a, b,
/// c turns left
bool is_inside_circle(Point a, Point b, Point c, Point d);

/// Returns whether an angle of the triangle a, b, c is larger than 90 degrees. Exact.
bool is_obtuse(Point a, Point b, Point c);

using Integer = boost::multiprecision::cpp_int;

/// @brief Represents coordinates by integers, as multiples of their largest common power of two.
class IntegerPlane {
public:
  /// @pre all coordinates are finite
  explicit IntegerPlane(const Mesh& mesh);
  /// Returns twice the signed area of the triangle a, b, c, in squares of the integer unit. Exact.
  Integer twice_area(Point a, Point b, Point c) const;
  Integer cross(Point u, Point v) const;
  /// Returns the area in the units of the file. @param twice result of twice_area()
  double area(const Integer& twice) const;

private:
  Integer integer(double value) const;

  int exponent_ = 0; // the unit is 2^exponent_
};

} // namespace trime_check
