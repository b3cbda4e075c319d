// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/feature_rule.hpp"

#include "boundary/rules.hpp"
#include "core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace trime::boundary {
namespace {

// [area of the shape] A loop that encloses more is never dropped.
constexpr double largest_dropped_share = 0.01;

using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;
using polygon::DroppedLoops;

/// Is the perimeter below `least` local sizes? Ends early for long loops.
bool is_small(const geometry::Boundary& boundary, const Loop& loop, const sizing::SizeField& size, double least) {
  double perimeter = 0;
  for (const Piece& piece : loop.pieces) {
    const double length = piece.length();
    perimeter += length / sizing::checked_size(size, boundary.periods.wrap(piece.point(0.5 * length)));
    if (!(perimeter < least))
      return false;
  }
  return true;
}

/// A loop as a polygon, arcs by many chords, and which points it encloses.
class Enclosure {
public:
  explicit Enclosure(const Loop& loop) {
    constexpr int parts_of_arc = 64;
    for (const Piece& piece : loop.pieces)
      for (int k = 0; k < (piece.circular ? parts_of_arc : 1); ++k) {
        corners_.push_back(k == 0 ? piece.start : piece.point(piece.length() * k / parts_of_arc));
        box_.include(corners_.back());
      }
  }
  const geometry::Box& box() const { return box_; }
  bool contains(Vec2 p) const {
    if (p.x < box_.min.x || p.x > box_.max.x || p.y < box_.min.y || p.y > box_.max.y)
      return false;
    bool inside = false;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Vec2 a = corners_[k], b = corners_[(k + 1) % corners_.size()];
      if ((a.y > p.y) != (b.y > p.y))
        inside ^= (cross(b - a, p - a) > 0) == (b.y > a.y);
    }
    return inside;
  }

private:
  std::vector<Vec2> corners_;
  geometry::Box box_;
};

/// Is one of the points, sorted by x, or an image of one, enclosed?
bool encloses_any(const Enclosure& loop, std::span<const Vec2> points, const geometry::Periods& periods) {
  const int nx = periods.x > 0 ? 2 : 0, ny = periods.y > 0 ? 2 : 0;
  for (int i = -nx; i <= nx; ++i) {
    const double shift = i * periods.x;
    for (auto p = std::lower_bound(points.begin(), points.end(), Vec2{loop.box().min.x - shift, -INFINITY},
                                   geometry::lexicographically_less);
         p != points.end() && p->x + shift <= loop.box().max.x; ++p)
      for (int j = -ny; j <= ny; ++j)
        if (loop.contains(*p + Vec2{shift, j * periods.y}))
          return true;
  }
  return false;
}

/// The longest component stays if all others go.
void keep_one_component(const geometry::Boundary& boundary, std::vector<char>& dropped) {
  if (boundary.covers_torus)
    return;
  std::size_t longest = boundary.loops.size();
  for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
    if (!boundary.loops[k].outer)
      continue;
    if (!dropped[k])
      return;
    if (longest == boundary.loops.size() || boundary.loops[k].length() > boundary.loops[longest].length())
      longest = k;
  }
  if (longest < boundary.loops.size())
    dropped[longest] = 0;
}

} // namespace

double enclosed_area(const Loop& loop) {
  const Vec2 origin = loop.pieces.front().start;
  double twice = 0;
  for (const Piece& piece : loop.pieces) {
    twice += cross(piece.start - origin, piece.end - origin);
    if (piece.circular)
      twice += piece.radius * piece.radius * (piece.sweep - sin_cos(piece.sweep).sin);
  }
  return 0.5 * twice;
}

DroppedLoops drop_small_loops(const geometry::Boundary& boundary, const sizing::SizeField& size, double least_perimeter,
                              std::span<const Vec2> inside) {
  DroppedLoops result;
  std::vector<char>& dropped = result.dropped;
  dropped.assign(boundary.loops.size(), 0);
  if (!(least_perimeter > 0))
    return result;
  for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
    const Loop& loop = boundary.loops[k];
    const bool asked_for =
        std::any_of(loop.pieces.begin(), loop.pieces.end(), [](const Piece& piece) { return piece.corner; });
    dropped[k] = !loop.winds() && !asked_for && is_small(boundary, loop, size, least_perimeter) &&
                 std::fabs(enclosed_area(loop)) <= largest_dropped_share * boundary.area;
  }
  keep_one_component(boundary, dropped);
  std::vector<Vec2> staying; // a point of each loop that stays
  for (std::size_t k = 0; k < boundary.loops.size(); ++k)
    if (!dropped[k])
      staying.push_back(boundary.loops[k].pieces.front().start);
  std::sort(staying.begin(), staying.end(), geometry::lexicographically_less);
  for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
    if (!dropped[k])
      continue;
    const Loop& loop = boundary.loops[k];
    const Enclosure enclosure(loop);
    dropped[k] =
        !encloses_any(enclosure, staying, boundary.periods) && !encloses_any(enclosure, inside, boundary.periods);
    if (!dropped[k])
      continue;
    const double area = std::fabs(enclosed_area(loop));
    ++(loop.outer ? result.components : result.holes);
    result.area += area;
    result.change += loop.outer ? -area : area;
  }
  if (result.any())
    result.share = result.area / boundary.area;
  return result;
}

geometry::Boundary boundary_without(const geometry::Boundary& boundary, const DroppedLoops& dropped) {
  geometry::Boundary rest = boundary;
  rest.loops.clear();
  for (std::size_t k = 0; k < boundary.loops.size(); ++k)
    if (!dropped.dropped[k])
      rest.loops.push_back(boundary.loops[k]);
  rest.area += dropped.change;
  return rest;
}

} // namespace trime::boundary
