// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/cornered_boundary.hpp"

#include "core/angle.hpp"
#include "geometry/piece_parts.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace trime::geometry {

namespace {

/// [tolerances] A point on a curve is at most 1 from it, and so is each corner that came before: the piece nearest to
/// the point lies within 2 of it, and within 4 the given piece that it is made of. Twice that, for rounding.
constexpr double search_reach = 8;

} // namespace

std::vector<Vec2> images_of(const Periods& periods) {
  std::vector<Vec2> shifts{{0, 0}};
  for (const double x : {-periods.x, 0.0, periods.x})
    for (const double y : {-periods.y, 0.0, periods.y})
      if (std::find(shifts.begin(), shifts.end(), Vec2{x, y}) == shifts.end())
        shifts.push_back({x, y});
  return shifts;
}

CorneredBoundary::CorneredBoundary(const Boundary& boundary, const PieceTree& pieces, double tolerance)
    : boundary_(boundary), tree_(pieces), tolerance_(tolerance), images_(images_of(boundary.periods)) {
  for (const Loop& loop : boundary.loops) {
    const std::size_t first = links_.size(), n = loop.pieces.size();
    for (std::size_t k = 0; k < n; ++k) {
      given_.push_back(&loop.pieces[k]);
      links_.push_back({loop.pieces[k], first + (k + n - 1) % n, first + (k + 1) % n, first + k, {}});
    }
  }
}

/// A loop may lead out of the container and its images next to it: where the piece lies then, too.
std::vector<Vec2> CorneredBoundary::shifts_of(std::size_t origin) const {
  if (!boundary_.periods.any())
    return images_;
  std::vector<Vec2> shifts = images_;
  const Vec2 middle = 0.5 * (given_[origin]->start + given_[origin]->end);
  const Vec2 away = middle - boundary_.periods.wrap(middle);
  for (const Vec2 shift : images_)
    if (std::find(shifts.begin(), shifts.end(), shift + away) == shifts.end())
      shifts.push_back(shift + away);
  return shifts;
}

/// Among equally near pieces, the first one along the boundary counts.
void CorneredBoundary::add_corner(Vec2 p) {
  Nearest best{std::numeric_limits<double>::infinity(), 0, p};
  for (const std::size_t origin : tree_.within(p, search_reach * tolerance_))
    for (const Vec2 shift : shifts_of(origin))
      look_near(origin, p + shift, best);
  TRIME_ASSERT(best.distance <= search_reach * tolerance_,
               "the point ({}, {}) is {} away from the boundary, at most {} are allowed", p.x, p.y, best.distance,
               tolerance_);
  Link& link = links_[best.link];
  const bool at_start = length(best.image - link.piece.start) <= tolerance_;
  const bool at_end = length(best.image - link.piece.end) <= tolerance_;
  if (!at_start && !at_end)
    return divide(best.link, best.image);
  Link& after = at_start ? link : links_[link.after];
  Link& before = links_[after.before];
  // Where the loop closes, its end is its start moved by the winding.
  const Vec2 moved = best.image - (at_start ? link.piece.start : link.piece.end);
  after.piece.start = after.piece.start + moved;
  before.piece.end = before.piece.end + moved;
  after.piece.corner = true;
}

/// Looks at the parts of a given piece that may be near the point.
void CorneredBoundary::look_near(std::size_t origin, Vec2 image, Nearest& best) {
  const auto found = parts_.find(origin);
  if (found == parts_.end())
    return look_at(origin, image, best);
  const Parts& parts = found->second;
  const double place = along(origin, image), reach = search_reach * tolerance_;
  const auto look = [&](double from, double to) {
    auto part = parts.lower_bound(from);
    if (part != parts.begin())
      --part; // begins before, and may end after `from`
    for (; part != parts.end() && part->first <= to; ++part)
      look_at(part->second, image, best);
  };
  look(place - reach, place + reach);
  if (given_[origin]->circular) // beyond half a turn, or at the end of a circle, which is its start
    look(place + 2 * pi * given_[origin]->radius - reach, place + 2 * pi * given_[origin]->radius + reach);
}

void CorneredBoundary::look_at(std::size_t link, Vec2 image, Nearest& best) {
  ++distances_;
  if (const double distance = links_[link].piece.distance(image); distance < best.distance)
    best = {distance, link, image};
}

/// How far from the start of a given piece the place nearest to p is; beyond half a turn of an arc a turn less.
double CorneredBoundary::along(std::size_t origin, Vec2 p) const {
  const Piece& piece = *given_[origin];
  if (!piece.circular)
    return dot(p - piece.start, piece.end - piece.start) / length(piece.end - piece.start);
  const Vec2 from = piece.start - piece.center, to = p - piece.center;
  const double angle = angle_of(cross(from, to), dot(from, to));
  return piece.radius * (piece.sweep < 0 ? -angle : angle);
}

void CorneredBoundary::divide(std::size_t link, Vec2 p) {
  const std::size_t origin = links_[link].origin, fresh = links_.size();
  const Piece& given = *given_[origin];
  const auto [parts, is_whole] = parts_.try_emplace(origin);
  if (is_whole)
    links_[link].place = parts->second.emplace(0.0, link);
  const Parts::iterator here = links_[link].place, next = std::next(here);
  const auto [first, second] = divided(links_[link].piece, p);
  links_.push_back({second, link, links_[link].after, origin, {}});
  links_[links_[fresh].after].before = fresh;
  links_[link].after = fresh;
  links_[link].piece = first;
  // The order along the loop, even where a point is seen a little before or behind the part that it divides.
  const double low = here->first, high = next == parts->second.end() ? given.length() : next->first;
  double place = along(origin, p);
  const auto beyond = [&](double v) { return std::fmax(0, std::fmax(low - v, v - high)); };
  if (given.circular && beyond(place + 2 * pi * given.radius) < beyond(place))
    place += 2 * pi * given.radius;
  place = std::fmax(low, std::fmin(place, high));
  links_[fresh].place = parts->second.emplace_hint(next, place, fresh);
}

Boundary CorneredBoundary::result() const {
  Boundary made = boundary_;
  std::size_t first = 0;
  for (Loop& loop : made.loops) {
    const std::size_t count = loop.pieces.size();
    loop.pieces.clear();
    for (std::size_t link = first; loop.pieces.empty() || link != first; link = links_[link].after)
      loop.pieces.push_back(links_[link].piece);
    first += count;
  }
  return made;
}

} // namespace trime::geometry
