// SPDX-License-Identifier: BSD-3-Clause
#include "trime/shape/part.hpp"

#include "core/angle.hpp"
#include "geometry/predicates.hpp"
#include "shape/contour_polygon.hpp"
#include "trime/core/error.hpp"

#include <cmath>

namespace trime::shape {
using geometry::cross;
using geometry::dot;
using geometry::Piece;
using geometry::Vec2;

std::array<Vec2, 4> quadrant_vertices(const Circle& circle) {
  const Vec2 c = circle.center;
  const double r = circle.radius;
  return {{{c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}, {c.x, c.y - r}}};
}

Piece make_arc(const Circle& circle, Vec2 a, Vec2 b) {
  const Vec2 from = a - circle.center, to = b - circle.center;
  Piece piece;
  piece.start = a;
  piece.end = b;
  piece.circular = true;
  piece.center = circle.center;
  piece.radius = circle.radius;
  piece.start_angle = angle_of(from.y, from.x);
  piece.sweep = angle_of(cross(from, to), dot(from, to));
  if (piece.sweep <= 0)
    piece.sweep += 2 * pi;
  return piece;
}

namespace {

using geometry::Box;
using geometry::cross;
using geometry::Frame;
using geometry::length;
using geometry::Loop;
using geometry::orient2d;
using geometry::Piece;
using geometry::Segment;
using geometry::Vec2;

constexpr int smallest_radius = 64; // [steps] Smallest radius of a circle, in lattice steps

void check_reach(const std::string& name, Vec2 p, const Frame& frame) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y))
    throw GeometryError(fmt::format("part '{}': expected finite numbers, found the point ({}, {})", name, p.x, p.y));
  const Box& box = frame.container();
  if (!frame.reach().contains(p))
    throw GeometryError(fmt::format("part '{}': the point ({}, {}) lies far outside the container [{}, {}] x [{}, {}]; "
                                    "expected it within twice the container's size; enlarge [domain]",
                                    name, p.x, p.y, box.min.x, box.max.x, box.min.y, box.max.y));
}

Vec2 place(const std::string& name, Vec2 p, const Frame& frame) {
  check_reach(name, p, frame);
  return frame.snap(p);
}

/// Rounding may carry a circle that touches the border of the container a step beyond: takes that step back.
double radius_within(const Circle& circle, const Frame& frame) {
  double radius = circle.radius;
  const Box& box = frame.inner();
  for (const double room : {circle.center.x - box.min.x, box.max.x - circle.center.x, circle.center.y - box.min.y,
                            box.max.y - circle.center.y})
    if (room < radius && room >= radius - 4 * frame.step())
      radius = room;
  return radius;
}

} // namespace

Part Part::rectangle(const std::string& name, const Box& box, const Frame& frame) {
  const Vec2 low = place(name, box.min, frame), high = place(name, box.max, frame);
  if (!(low.x < high.x && low.y < high.y))
    throw GeometryError(fmt::format("part '{}': expected x_min < x_max and y_min < y_max, found [{}, {}] x [{}, {}]",
                                    name, box.min.x, box.max.x, box.min.y, box.max.y));
  return Part(name, make_simple_polygon({low, {high.x, low.y}, high, {low.x, high.y}}));
}

Part Part::circle(const std::string& name, Vec2 center, double radius, const Frame& frame) {
  if (!(radius > smallest_radius * frame.step()) || !std::isfinite(radius))
    throw GeometryError(fmt::format("part '{}': expected a positive radius, at least {:.3g} in this container, found "
                                    "{}",
                                    name, smallest_radius * frame.step(), radius));
  check_reach(name, center - Vec2{radius, radius}, frame);
  check_reach(name, center + Vec2{radius, radius}, frame);
  Circle circle{frame.lattice().snap(center), frame.lattice().snap(radius)};
  circle.radius = radius_within(circle, frame);
  return Part(name, circle);
}

Part Part::triangle(const std::string& name, const std::array<Vec2, 3>& corners, const Frame& frame) {
  const Vec2 a = place(name, corners[0], frame), b = place(name, corners[1], frame), c = place(name, corners[2], frame);
  const int orientation = orient2d(a, b, c);
  if (orientation == 0)
    throw GeometryError(fmt::format("part '{}': the corners ({}, {}), ({}, {}), ({}, {}) lie on one line; expected a "
                                    "triangle with an area",
                                    name, corners[0].x, corners[0].y, corners[1].x, corners[1].y, corners[2].x,
                                    corners[2].y));
  return Part(name, make_simple_polygon(orientation > 0 ? std::vector<Vec2>{a, b, c} : std::vector<Vec2>{a, c, b}));
}

Part Part::contour(const std::string& name, const contours::Contour& contour,
                   const contours::Normalization& normalization, const Frame& frame, const TouchOptions& touches) {
  std::vector<std::string> warnings = contour.warnings;
  Part part(name, make_contour_polygon(contour, normalization, frame, warnings, touches));
  part.warnings_ = std::move(warnings);
  part.is_contour_ = true;
  return part;
}

Part Part::curve(const std::string& name, std::vector<CurveLine> lines, const Frame& frame) {
  std::vector<Segment> segments;
  std::vector<Polygon::Ring> rings;
  std::vector<std::string> labels;
  for (CurveLine& line : lines) {
    line.labels.resize(line.points.size());
    const std::size_t first = segments.size();
    const auto add = [&](Vec2 from, Vec2 to, std::size_t k) {
      if (from == to)
        return;
      segments.push_back({from, to});
      labels.push_back(line.labels[k]);
    };
    for (Vec2& p : line.points)
      p = place(name, p, frame);
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
      add(line.points[k], line.points[k + 1], k);
    if (line.closed && line.points.size() > 2)
      add(line.points.back(), line.points.front(), line.points.size() - 1);
    if (segments.size() == first)
      throw GeometryError(fmt::format("curve '{}'{}: expected lines with two different points, found {} at one place",
                                      name, line.labels.empty() ? "" : fmt::format(" ({})", line.labels[0]),
                                      line.points.size()));
    const bool closes = segments.back().b == segments[first].a;
    rings.push_back({static_cast<LocalIndex>(first), static_cast<LocalIndex>(segments.size() - first), false, !closes});
  }
  Part part(name, Polygon{geometry::SegmentGrid(std::move(segments)), std::move(rings), {}, {}, {}, std::move(labels)});
  part.is_curve_ = true;
  return part;
}

Part Part::polygon(const std::string& name, Polygon polygon, std::vector<std::string> warnings) {
  Part part(name, std::move(polygon));
  part.warnings_ = std::move(warnings);
  return part;
}

std::vector<Loop> Part::boundary() const {
  std::vector<Loop> loops;
  if (const Circle* circle = as_circle()) {
    const std::array<Vec2, 4> v = quadrant_vertices(*circle);
    loops.emplace_back();
    for (int k = 0; k < 4; ++k)
      loops[0].pieces.push_back(make_arc(*circle, v[k], v[(k + 1) % 4]));
    return loops;
  }
  const Polygon& polygon = *as_polygon();
  for (const Polygon::Ring& ring : polygon.rings) {
    Loop loop;
    loop.tag = static_cast<int>(loops.size()) + 1;
    double twice_area = 0;
    const Vec2 origin = polygon.grid.segments()[ring.first].a;
    for (LocalIndex k = 0; k < ring.count; ++k) {
      const Segment& s = polygon.grid.segments()[ring.first + (ring.reversed ? ring.count - 1 - k : k)];
      Piece piece;
      piece.start = ring.reversed ? s.b : s.a;
      piece.end = ring.reversed ? s.a : s.b;
      twice_area += cross(piece.start - origin, piece.end - origin);
      loop.pieces.push_back(piece);
    }
    loop.outer = twice_area > 0;
    loops.push_back(std::move(loop));
  }
  return loops;
}

bool Part::inside(Vec2 p) const {
  if (is_curve_)
    return false;
  if (const Polygon* polygon = as_polygon())
    return polygon->grid.inside(p);
  // Products of lattice differences: the float decides unless the two sides are equal, then their errors do.
  const Circle& circle = *as_circle();
  const Vec2 d = p - circle.center;
  const double left = d.x * d.x, right = (circle.radius - d.y) * (circle.radius + d.y);
  if (left != right)
    return left < right;
  return std::fma(d.x, d.x, -left) < std::fma(circle.radius - d.y, circle.radius + d.y, -right);
}

double Part::distance(Vec2 p) const {
  if (const Polygon* polygon = as_polygon())
    return std::sqrt(polygon->grid.nearest(p).squared_distance);
  return std::fabs(length(p - as_circle()->center) - as_circle()->radius);
}

} // namespace trime::shape
