// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/fixed_points.hpp"

#include "boundary/rules.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace trime::boundary {

using geometry::Vec2;
using polygon::BoundaryGuard;

namespace {

/// The shifts under which a point may be seen from the container and next to it.
std::vector<Vec2> images_of(const geometry::Periods& periods) {
  std::vector<Vec2> shifts{{0, 0}};
  for (const double x : {-periods.x, 0.0, periods.x})
    for (const double y : {-periods.y, 0.0, periods.y})
      if (std::find(shifts.begin(), shifts.end(), Vec2{x, y}) == shifts.end())
        shifts.push_back({x, y});
  return shifts;
}

SiteTree tree_of(const std::vector<Vec2>& points) {
  std::vector<SiteTree::Entry> items;
  for (std::size_t k = 0; k < points.size(); ++k)
    items.push_back({points[k], static_cast<LocalIndex>(k)});
  return SiteTree(std::move(items));
}

/// The part of a piece before p, or the one after it. @pre p lies on the piece
std::array<geometry::Piece, 2> divided(const geometry::Piece& piece, Vec2 p) {
  std::array<geometry::Piece, 2> parts{piece, piece};
  parts[0].end = parts[1].start = p;
  if (piece.circular) {
    const Vec2 from = piece.start - piece.center, to = p - piece.center;
    double sweep = angle_of(cross(from, to), dot(from, to));
    if (piece.sweep > 0 && sweep < 0)
      sweep += 2 * pi;
    if (piece.sweep < 0 && sweep > 0)
      sweep -= 2 * pi;
    parts[0].sweep = sweep;
    parts[1].sweep = piece.sweep - sweep;
    parts[1].start_angle = angle_of(to.y, to.x);
  }
  parts[1].corner = true;
  return parts;
}

/// A point is nearer than the local size to something else.
struct Closeness {
  std::size_t count = 0;
  double least = std::numeric_limits<double>::infinity(); // distance over size
  double distance = 0;
  Vec2 first, second;
  bool to_boundary = false;
};

} // namespace

FixedPoints::FixedPoints(const geometry::Boundary& boundary, const geometry::Box& box,
                         std::span<const FixedPoint> given, const geometry::Lattice& lattice, Log& log)
    : given_(given), lattice_(lattice), boundary_(boundary),
      tolerance_(BoundaryRules::on_boundary * std::max(box.width(), box.height())), tree_({}) {
  std::vector<Vec2> places;
  for (const FixedPoint& point : given) {
    const Vec2 p = point.position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      throw GeometryError(fmt::format("{}: expected finite coordinates, found ({}, {})", point.label, p.x, p.y));
    const bool beyond = (boundary.periods.x == 0 && (p.x < box.min.x || p.x > box.max.x)) ||
                        (boundary.periods.y == 0 && (p.y < box.min.y || p.y > box.max.y));
    if (beyond)
      throw GeometryError(fmt::format("{}: the fixed point ({}, {}) lies outside the container [{}, {}] x [{}, {}]; "
                                      "expected a point in the shape",
                                      point.label, p.x, p.y, box.min.x, box.max.x, box.min.y, box.max.y));
    places.push_back(boundary.periods.wrap(lattice.snap(p)));
  }
  std::vector<std::size_t> order(given.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lexicographically_less(places[a], places[b]); });
  for (const std::size_t k : order) {
    if (!all_.empty() && all_.back() == places[k]) {
      log.warning("{}: the fixed point ({}, {}) is the same as that of {}; it is kept once", given[k].label,
                  given[k].position.x, given[k].position.y, given[source_.back()].label);
      continue;
    }
    all_.push_back(places[k]);
    source_.push_back(k);
  }
  const geometry::PieceTree pieces(boundary);
  const std::vector<Vec2> images = images_of(boundary.periods);
  for (const Vec2 p : all_) {
    const bool on_curve =
        std::any_of(images.begin(), images.end(), [&](Vec2 s) { return pieces.distance(p + s) <= tolerance_; });
    if (on_curve) {
      check_apart(p);
      add_corner(p);
      on_curve_.push_back(p);
    } else {
      inside_.push_back(p);
    }
  }
  tree_ = tree_of(inside_);
}

/// Where two points on the boundary are nearer than what counts as on it, only one of them could be a corner.
void FixedPoints::check_apart(Vec2 p) const {
  // The earlier ones stand in the order of x, but images may be anywhere.
  for (const Vec2 shift : images_of(boundary_.periods)) {
    const double from = p.x + shift.x - tolerance_;
    for (auto q = std::lower_bound(on_curve_.begin(), on_curve_.end(), Vec2{from, -INFINITY},
                                   geometry::lexicographically_less);
         q != on_curve_.end() && q->x <= p.x + shift.x + tolerance_; ++q)
      if (const double distance = geometry::length(*q - (p + shift)); distance <= tolerance_)
        throw GeometryError(fmt::format(
            "{}: the fixed point ({:.12g}, {:.12g}) on the boundary is {:.2g} from that of {}: expected the same point "
            "or a distance above {:.2g}; take out one of them",
            label(p), p.x, p.y, distance, label(*q), tolerance_));
  }
}

/// The nearest piece of all is divided at p, or its end moved there if that is as near.
void FixedPoints::add_corner(Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  geometry::Loop* loop = nullptr;
  std::size_t index = 0;
  Vec2 q;
  for (geometry::Loop& candidate : boundary_.loops)
    for (std::size_t k = 0; k < candidate.pieces.size(); ++k)
      for (const Vec2 shift : images_of(boundary_.periods))
        if (const double distance = candidate.pieces[k].distance(p + shift); distance < least) {
          least = distance;
          loop = &candidate;
          index = k;
          q = p + shift;
        }
  std::vector<geometry::Piece>& pieces = loop->pieces;
  const bool at_start = geometry::length(q - pieces[index].start) <= tolerance_;
  const bool at_end = geometry::length(q - pieces[index].end) <= tolerance_;
  if (!at_start && !at_end) {
    const auto parts = divided(pieces[index], q);
    pieces[index] = parts[1];
    pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(index), parts[0]);
    return;
  }
  const std::size_t n = pieces.size(), after = at_start ? index : (index + 1) % n, before = (after + n - 1) % n;
  // Where the loop closes, its end is its start moved by the winding.
  const Vec2 moved = q - (at_start ? pieces[index].start : pieces[index].end);
  pieces[after].start = pieces[after].start + moved;
  pieces[before].end = pieces[before].end + moved;
  pieces[after].corner = true;
}

const std::string& FixedPoints::label(Vec2 p) const {
  const auto found = std::lower_bound(all_.begin(), all_.end(), p, geometry::lexicographically_less);
  return given_[source_[static_cast<std::size_t>(found - all_.begin())]].label;
}

void FixedPoints::check_inside(const BoundaryGuard& guard) const {
  for (const Vec2 p : inside_) {
    if (guard.inside(p))
      continue;
    const geometry::PieceTree pieces(boundary_);
    double distance = std::numeric_limits<double>::infinity();
    for (const Vec2 shift : images_of(boundary_.periods))
      distance = std::fmin(distance, pieces.distance(p + shift));
    throw GeometryError(
        fmt::format("{}: the fixed point ({:.9g}, {:.9g}) lies outside the shape, {:.6g} from its boundary; "
                    "expected a point inside, or on the boundary to within {:.2g}",
                    label(p), p.x, p.y, distance, tolerance_));
  }
}

/// Is a point of inside_ nearer to p?
bool FixedPoints::is_near(Vec2 p, double distance) const {
  const Vec2 across{distance, 0};
  for (const Vec2 shift : images_of(boundary_.periods))
    if (tree_.find_in_disc(lattice_.snap(p + shift - across), lattice_.snap(p + shift + across), -1, -1) >= 0)
      return true;
  return false;
}

std::int64_t FixedPoints::count_clear(std::span<const mesh::Site> sites, const sizing::SizeField& size) const {
  std::vector<std::uint8_t> clear(sites.size());
  thread_loop(static_cast<std::ptrdiff_t>(sites.size()), 256, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    clear[k] = !is_near(sites[k].position, BoundaryRules::fixed_clearance * size.size(sites[k].position));
  });
  return std::count(clear.begin(), clear.end(), std::uint8_t{1});
}

void FixedPoints::place_among(mesh::SiteList& sites, const mesh::TileRange& tiles,
                              const sizing::SizeField& size) const {
  if (inside_.empty())
    return;
  std::vector<std::uint8_t> taken(sites.size());
  thread_loop(static_cast<std::ptrdiff_t>(sites.size()), 256, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    const mesh::Site& site = sites[k];
    taken[k] = site.boundary == mesh::fixed_site || // from an earlier stage
               (site.boundary == mesh::free_site &&
                is_near(site.position, BoundaryRules::fixed_clearance * size.size(site.position)));
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < sites.size(); ++k)
    if (!taken[k])
      sites[kept++] = sites[k];
  sites.resize(kept);
  for (const Vec2 p : inside_) {
    const LocalIndex tile = tiles.grid.place(p).tile;
    if (tile >= tiles.first && tile < tiles.last)
      sites.push_back({p, mesh::fixed_site});
  }
}

void FixedPoints::warn_of_close_ones(const BoundaryGuard& guard, const sizing::SizeField& size, Log& log) const {
  Closeness close;
  std::vector<std::uint8_t> is_close(inside_.size(), 0);
  const auto note = [&](Vec2 p, Vec2 other, double distance, double h, bool to_boundary) {
    if (distance / h < close.least)
      close = {0, distance / h, distance, p, other, to_boundary};
  };
  for (std::size_t k = 0; k < inside_.size(); ++k) {
    const Vec2 p = inside_[k];
    const double h = size.size(p);
    if (const double distance = guard.distance(p, h); distance < h) {
      is_close[k] = 1;
      note(p, p, distance, h, true);
    }
    // They stand in the order of x.
    for (std::size_t j = k + 1; j < inside_.size() && inside_[j].x - p.x < h; ++j)
      if (const double distance = geometry::length(inside_[j] - p); distance < h) {
        is_close[k] = is_close[j] = 1;
        note(p, inside_[j], distance, h, false);
      }
  }
  const auto count = std::count(is_close.begin(), is_close.end(), 1);
  if (count == 0)
    return;
  const std::string what =
      close.to_boundary
          ? fmt::format("({:.9g}, {:.9g}) is {:.3g} from the boundary", close.first.x, close.first.y, close.distance)
          : fmt::format("({:.9g}, {:.9g}) and ({:.9g}, {:.9g}) are {:.3g} apart", close.first.x, close.first.y,
                        close.second.x, close.second.y, close.distance);
  log.warning("{} of {} fixed points inside are nearer than the local size to each other or to the boundary: expect "
              "small angles there; the closest: {}, {:.2g} of the size",
              count, inside_.size(), what, close.least);
}

} // namespace trime::boundary
