// SPDX-License-Identifier: BSD-3-Clause
#include "shape/crossings.hpp"

#include <algorithm>
#include <cmath>

namespace trime::shape {

namespace {

using geometry::length;
using geometry::Segment;
using geometry::Vec2;

/// a*b - c*d.
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

} // namespace

double accurate_cross(Vec2 a, Vec2 b) {
  return difference_of_products(a.x, b.y, a.y, b.x);
}
double accurate_dot(Vec2 a, Vec2 b) {
  return difference_of_products(a.x, b.x, -a.y, b.y);
}

Vec2 line_crossing(const Segment& s, const Segment& t) {
  const Vec2 d = s.b - s.a, e = t.b - t.a;
  const double along = std::clamp(accurate_cross(t.a - s.a, e) / accurate_cross(d, e), 0.0, 1.0);
  return s.a + along * d;
}

Crossings segment_circle_crossings(const Segment& s, const Circle& circle, double tolerance) {
  Crossings crossings;
  const Vec2 d = s.b - s.a, u = s.a - circle.center;
  const double whole = length(d), across = std::fabs(accurate_cross(d, u)) / whole;
  if (across > circle.radius + tolerance)
    return crossings;
  const double foot = -accurate_dot(u, d) / whole;
  const bool a_touches = std::fabs(signed_distance(s.a, circle)) <= tolerance;
  const bool b_touches = std::fabs(signed_distance(s.b, circle)) <= tolerance;
  const auto add = [&](double along) {
    if (along > 0 && along < whole)
      crossings.add(s.a + (along / whole) * d);
  };
  if (across >= circle.radius - tolerance) {
    if (!a_touches && !b_touches)
      add(foot);
    return crossings;
  }
  const double half = std::sqrt((circle.radius - across) * (circle.radius + across));
  const double first = foot - half, second = foot + half;
  const auto stands_for_first = [&](double end) { return std::fabs(end - first) < std::fabs(end - second); };
  const bool first_taken = (a_touches && stands_for_first(0)) || (b_touches && stands_for_first(whole));
  const bool second_taken = (a_touches && !stands_for_first(0)) || (b_touches && !stands_for_first(whole));
  if (!first_taken)
    add(first);
  if (!second_taken)
    add(second);
  return crossings;
}

Crossings circle_crossings(const Circle& a, const Circle& b, double tolerance) {
  Crossings crossings;
  const Vec2 d = b.center - a.center;
  const double distance = length(d), sum = a.radius + b.radius, difference = a.radius - b.radius;
  if (distance > sum + tolerance || distance < std::fabs(difference) - tolerance || distance == 0)
    return crossings;
  const Vec2 direction = (1 / distance) * d;
  if (std::fabs(distance - sum) <= tolerance) {
    crossings.add(a.center + a.radius * direction);
    return crossings;
  }
  if (std::fabs(distance - std::fabs(difference)) <= tolerance) {
    // Seen from the larger circle, the contact lies behind the centre of the smaller one.
    crossings.add(difference > 0 ? a.center + a.radius * direction : b.center - b.radius * direction);
    return crossings;
  }
  const double along = 0.5 * (distance + difference * sum / distance);
  const double product = (sum - distance) * (sum + distance) * (distance - difference) * (distance + difference);
  const double height = 0.5 * std::sqrt(product) / distance;
  const Vec2 middle = a.center + along * direction, normal = height * left_normal(direction);
  crossings.add(middle + normal);
  crossings.add(middle - normal);
  return crossings;
}

double signed_distance(Vec2 p, const Circle& circle) {
  return length(p - circle.center) - circle.radius;
}

} // namespace trime::shape
