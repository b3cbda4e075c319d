// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/medial_axis.hpp"

#include "core/angle.hpp"
#include "sizing/rules.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

using geometry::Vec2;

namespace {

constexpr int most_shrinks = 50;

double signed_turn(Vec2 before, Vec2 after) {
  return angle_of(cross(before, after), dot(before, after));
}

Vec2 turned(Vec2 v, double angle) {
  const SinCos t = sin_cos(angle);
  return {t.cos * v.x - t.sin * v.y, t.sin * v.x + t.cos * v.y};
}

/// Where a ball through the origin touches, seen from there.
struct Contact {
  Vec2 chord;
  double radius;
};

/// Returns the ball that touches the inside of a segment, with its centre on the ray from the origin along `normal`, or
/// nothing.
std::optional<Contact> contact_with(Vec2 a, Vec2 b, Vec2 normal) {
  const Vec2 d = b - a;
  const double squared = squared_length(d);
  if (!(squared > 0))
    return std::nullopt;
  Vec2 to_origin = (1 / std::sqrt(squared)) * left_normal(d); // unit normal of the segment
  double distance = -dot(a, to_origin);
  if (distance < 0) {
    distance = -distance;
    to_origin = -1 * to_origin;
  }
  const double radius = distance / (1 - dot(normal, to_origin));
  const Vec2 chord = radius * (normal - to_origin);
  const double place = dot(chord - a, d);
  return distance > 0 && place > 0 && place < squared ? std::optional(Contact{chord, radius}) : std::nullopt;
}

} // namespace

void append_rays(Vec2 p, Vec2 tangent, std::vector<NormalRay>& rays) {
  const Vec2 normal = left_normal(tangent);
  rays.push_back({p, normal, 0});
  rays.push_back({p, -1 * normal, 1});
}

void append_rays(Vec2 p, Vec2 before, Vec2 after, std::vector<NormalRay>& rays) {
  const double turn = signed_turn(before, after);
  if (std::fabs(turn) < SizingRules::straight)
    return append_rays(p, turned(before, 0.5 * turn), rays);
  const Vec2 normal = turn < 0 ? left_normal(before) : -1 * left_normal(before); // to the side of the fan
  const int steps = static_cast<int>(std::ceil(std::fabs(turn) / SizingRules::fan_step));
  for (int k = 0; k <= steps; ++k)
    rays.push_back({p, turned(normal, turn * k / steps), turn < 0 ? 0 : 1});
  rays.push_back({p, turned(-1 * normal, 0.5 * turn), turn < 0 ? 1 : 0});
}

bool axis_ends_at(Vec2 before, Vec2 after) {
  return std::fabs(signed_turn(before, after)) >= separation_degrees * degrees * (1 - 1e-9);
}

std::optional<Vec2> medial_point(const NormalRay& ray, const PieceLocator& boundary, const Images& images,
                                 double& radius) {
  const geometry::Box& container = images.container();
  const double largest = geometry::length(container.max - container.min), smallest = 1e-12 * largest;
  const auto center_of = [&](double of) { return ray.origin + of * ray.normal; };
  const auto nearest = [&](double of) {
    return boundary.nearest(images.wrap(center_of(of)), SizingRules::empty_share * of);
  };
  radius = std::min(radius, largest);
  std::optional<PieceLocator::Nearest> near = nearest(radius);
  for (; !near && radius < largest; near = nearest(radius))
    radius = std::min(largest, SizingRules::first_growth * radius);
  // The ball before the last, unless it sees the boundary at a small angle only.
  std::optional<Vec2> found;
  bool touches = false;
  for (int round = 0; round < most_shrinks; ++round, near = nearest(radius)) {
    const Vec2 center = center_of(radius), wrapped = images.wrap(center);
    if (touches && (!near || length(near->point - wrapped) >= SizingRules::nearly_empty_share * radius))
      found = wrapped;
    if (!near)
      break;
    const Vec2 shift = center - wrapped - ray.origin, chord = near->point + shift;
    const double along = dot(chord, ray.normal), squared = squared_length(chord);
    if (!(along > 0) || squared <= smallest * smallest)
      break;
    const Contact contact = contact_with(near->segment_start + shift, near->segment_end + shift, ray.normal)
                                .value_or(Contact{chord, 0.5 * squared / along});
    radius = std::min(radius, contact.radius);
    touches = squared_length(contact.chord) >= radius * radius; // so long a chord is seen at 60 degrees from the centre
  }
  return found && images.in_container(*found) ? found : std::nullopt;
}

} // namespace trime::sizing
