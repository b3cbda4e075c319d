// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/curve_middles.hpp"

#include "core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace trime::refinement {

using geometry::Piece;
using geometry::Vec2;

namespace {

// [side of the container] Vertices that lie so far from a curve still lie on it, as in the certificate of a run.
constexpr double on_curve = 1e-9;
// [length of the edge] Ends of edges that lie so far from a curve still follow it: where the boundary was simplified,
// vertices lie near the curve. Traced curves were moved by up to 1e-4 h, ragged coasts by up to 0.5 h.
constexpr double near_curve = 0.02;
// [length of the edge] A curve between the ends of an edge that is longer does not belong to the edge: it goes around a
// part of the shape that the mesh leaves out. An arc of 60 degrees is 1.05 times as long. Not measured.
constexpr double longest_curve = 3;
// [length of the edge] A vertex on the curve lies at most so far from the middle of the edge: in the diametral circle
// of the edge, in which there are no other vertices.
constexpr double farthest = 0.5;

/// Returns the length from the start of a piece to a point on it.
double length_along(const Piece& piece, Vec2 p) {
  if (!piece.circular) {
    const Vec2 d = piece.end - piece.start;
    const double length = geometry::length(d);
    return std::clamp(dot(p - piece.start, d) / length, 0.0, length);
  }
  const Vec2 from_center = p - piece.center;
  const double whole = std::fabs(piece.sweep);
  double turn = (angle_of(from_center.y, from_center.x) - piece.start_angle) * (piece.sweep > 0 ? 1 : -1);
  turn -= 2 * pi * std::floor(turn / (2 * pi));
  if (turn > whole) // at one of the ends, except for rounding
    turn = turn - whole < 2 * pi - turn ? whole : 0;
  return piece.radius * turn;
}

} // namespace

CurveMiddles::CurveMiddles(const geometry::Boundary& boundary, double side)
    : boundary_(boundary), tree_(boundary), tolerance_(on_curve * side) {
  first_.push_back(0);
  for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop) {
    double length = 0;
    for (const Piece& piece : boundary.loops[loop].pieces) {
      pieces_.push_back(&piece);
      loop_of_.push_back(loop);
      start_.push_back(length);
      length += piece.length();
    }
    first_.push_back(pieces_.size());
    length_.push_back(length);
  }
}

/// In a periodic container a loop is unrolled, so a piece may pass through an image of the point.
void CurveMiddles::add_places(std::size_t number, Vec2 p, double tolerance, std::vector<Along>& places) const {
  const geometry::Periods& periods = boundary_.periods;
  const Piece& one = piece(number);
  const Vec2 near = periods.nearest_image(p, one.start);
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1}) {
      if ((i != 0 && periods.x == 0) || (j != 0 && periods.y == 0))
        continue;
      const Vec2 image{near.x + i * periods.x, near.y + j * periods.y};
      if (one.distance(image) > tolerance)
        continue;
      const double along = length_along(one, image);
      places.push_back({loop_of_[number], start_[number] + along, image - one.point(along)});
    }
}

/// Returns the nearest place, and others that are as near: of two pieces that meet, or where another loop is near.
std::vector<CurveMiddles::Along> CurveMiddles::places_of(Vec2 p, double tolerance) const {
  std::vector<Along> places;
  for (const std::size_t number : tree_.within(p, tolerance))
    add_places(number, p, tolerance, places);
  double least = tolerance;
  for (const Along& place : places)
    least = std::min(least, geometry::length(place.away));
  std::erase_if(places, [&](const Along& place) { return geometry::length(place.away) > least + tolerance_; });
  return places;
}

/// Returns the shortest way forward.
std::optional<CurveMiddles::Way> CurveMiddles::way_between(Vec2 a, Vec2 b) const {
  const double chord = geometry::length(b - a);
  const double tolerance = std::max(tolerance_, near_curve * chord);
  const std::vector<Along> starts = places_of(a, tolerance), ends = places_of(b, tolerance);
  double shortest = longest_curve * chord;
  std::optional<Way> best;
  for (const Along& from : starts)
    for (const Along& to : ends) {
      if (from.loop != to.loop)
        continue;
      double way = to.length - from.length;
      if (way < 0.5 * chord) // no way is much shorter than the chord: it passes the start of the loop
        way += length_[from.loop];
      if (way < shortest && way >= 0.5 * chord) {
        shortest = way;
        best = Way{from, way, 0.5 * (from.away + to.away)};
      }
    }
  return best;
}

std::optional<CurveMiddle> CurveMiddles::middle(Vec2 a, Vec2 b, int part) const {
  const std::optional<Way> way = way_between(a, b);
  if (!way)
    return std::nullopt;
  const std::size_t loop = way->from.loop;
  const double whole = length_[loop];
  double along = way->from.length + 0.5 * way->length;
  if (along >= whole)
    along -= whole;
  const auto begin = start_.begin() + static_cast<std::ptrdiff_t>(first_[loop]);
  const auto end = start_.begin() + static_cast<std::ptrdiff_t>(first_[loop + 1]);
  const auto number = static_cast<std::size_t>(std::upper_bound(begin, end, along) - start_.begin()) - 1;
  if (piece(number).part != part)
    return std::nullopt;
  const Vec2 straight = 0.5 * (a + b);
  const Vec2 place = boundary_.periods.nearest_image(piece(number).point(along - start_[number]), straight);
  const bool is_on_curve = geometry::length(way->away) <= tolerance_;
  const Vec2 found = is_on_curve ? place : place + way->away;
  if (!(geometry::length(found - straight) <= farthest * geometry::length(b - a)))
    return std::nullopt;
  return CurveMiddle{found, is_on_curve};
}

} // namespace trime::refinement
