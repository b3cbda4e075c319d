// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/medial_axis.hpp"

#include "trime/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

using geometry::Vec2;

namespace {

constexpr double fan_step = 20 * pi / 180; // between the rays from a vertex
constexpr double straight = 5 * pi / 180;  // a turn that needs no fan
constexpr int most_shrinks = 50;
constexpr double first_growth = 4;         // of a first ball that is empty
constexpr double empty_share = 1 - 1e-3;   // of its radius: so far a ball's centre is from the boundary if it is empty
constexpr double nearly_empty_share = 0.7; // the same for a ball with nothing but noise in it

double signed_turn(Vec2 before, Vec2 after) {
  return angle_of(cross(before, after), dot(before, after));
}

Vec2 turned(Vec2 v, double angle) {
  const SinCos t = sin_cos(angle);
  return {t.cos * v.x - t.sin * v.y, t.sin * v.x + t.cos * v.y};
}

} // namespace

void append_rays(Vec2 p, Vec2 tangent, std::vector<NormalRay>& rays) {
  const Vec2 normal = left_normal(tangent);
  rays.push_back({p, normal, 0});
  rays.push_back({p, -1 * normal, 1});
}

void append_rays(Vec2 p, Vec2 before, Vec2 after, std::vector<NormalRay>& rays) {
  const double turn = signed_turn(before, after);
  if (std::fabs(turn) < straight)
    return append_rays(p, turned(before, 0.5 * turn), rays);
  const Vec2 normal = turn < 0 ? left_normal(before) : -1 * left_normal(before); // to the side of the fan
  const int steps = static_cast<int>(std::ceil(std::fabs(turn) / fan_step));
  for (int k = 0; k <= steps; ++k)
    rays.push_back({p, turned(normal, turn * k / steps), turn < 0 ? 0 : 1});
  rays.push_back({p, turned(-1 * normal, 0.5 * turn), turn < 0 ? 1 : 0});
}

bool axis_ends_at(Vec2 before, Vec2 after) {
  return std::fabs(signed_turn(before, after)) >= separation_degrees * (pi / 180) * (1 - 1e-9);
}

std::optional<Vec2> medial_point(const NormalRay& ray, const PieceLocator& boundary, const Images& images,
                                 double& radius) {
  const geometry::Box& container = images.container();
  const double largest = geometry::length(container.max - container.min), smallest = 1e-12 * largest;
  const auto center_of = [&](double of) { return ray.origin + of * ray.normal; };
  const auto nearest = [&](double of) { return boundary.nearest(images.wrap(center_of(of)), empty_share * of); };
  radius = std::min(radius, largest);
  std::optional<Vec2> near = nearest(radius);
  for (; !near && radius < largest; near = nearest(radius))
    radius = std::min(largest, first_growth * radius);
  // The ball before the last, unless it sees the boundary at a small angle only.
  std::optional<Vec2> found;
  bool touches = false;
  for (int round = 0; round < most_shrinks; ++round, near = nearest(radius)) {
    const Vec2 center = center_of(radius), wrapped = images.wrap(center);
    if (touches && (!near || length(*near - wrapped) >= nearly_empty_share * radius))
      found = wrapped;
    if (!near)
      break;
    const Vec2 chord = *near + (center - wrapped) - ray.origin;
    const double along = dot(chord, ray.normal), squared = squared_length(chord);
    if (!(along > 0) || squared <= smallest * smallest)
      break;
    radius = std::min(radius, 0.5 * squared / along);
    touches = squared >= radius * radius; // a chord as long as the radius is seen at 60 degrees from the centre
  }
  return found && images.in_container(*found) ? found : std::nullopt;
}

} // namespace trime::sizing
