// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/feature_rule.hpp"

#include "boundary/rules.hpp"
#include "core/angle.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

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

namespace {

/// The outer loops that are left, the smallest first, and the component of each hole.
class ComponentFinder {
public:
  ComponentFinder(const geometry::Boundary& boundary, const std::vector<char>& dropped)
      : boundary_(boundary), of_loop_(boundary.loops.size(), none) {
    for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
      areas_.push_back(enclosed_area(boundary.loops[k]));
      if (boundary.loops[k].outer && !dropped[k])
        outer_.push_back(k);
    }
    std::stable_sort(outer_.begin(), outer_.end(), [&](std::size_t a, std::size_t b) { return areas_[a] < areas_[b]; });
    for (const std::size_t k : outer_)
      enclosures_.emplace_back(boundary.loops[k]);
    for (std::size_t k = 0; k < boundary.loops.size(); ++k)
      if (dropped[k] == 0)
        of_loop_[k] = boundary.loops[k].outer ? k : around(boundary.loops[k].pieces.front().start, -areas_[k]);
  }

  static constexpr std::size_t none = SIZE_MAX;
  /// The outer loop of the component to which a loop belongs.
  std::size_t component_of(std::size_t loop) const { return of_loop_[loop]; }

  std::size_t largest() const {
    std::vector<double> areas(areas_.size());
    for (std::size_t k = 0; k < areas_.size(); ++k)
      if (of_loop_[k] != none)
        areas[of_loop_[k]] += areas_[k];
    return static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  }
  /// The component that holds p; none if that is outside.
  std::size_t holding(Vec2 p) const {
    const std::size_t outer = around(p, 0);
    for (std::size_t k = 0; k < areas_.size(); ++k)
      if (of_loop_[k] == outer && k != outer && Enclosure(boundary_.loops[k]).contains(p))
        return none;
    return outer;
  }
  /// The component with the vertex that is nearest to p.
  std::size_t nearest(Vec2 p) const {
    std::size_t found = none;
    double least = INFINITY;
    for (std::size_t k = 0; k < areas_.size(); ++k)
      for (const Piece& piece : boundary_.loops[k].pieces)
        if (const double d = squared_length(piece.start - p); of_loop_[k] != none && d < least) {
          least = d;
          found = of_loop_[k];
        }
    return found;
  }

private:
  /// The smallest outer loop around p that encloses more than an area.
  std::size_t around(Vec2 p, double area) const {
    for (std::size_t k = 0; k < outer_.size(); ++k)
      if (areas_[outer_[k]] > area && enclosures_[k].contains(p))
        return outer_[k];
    return none;
  }

  const geometry::Boundary& boundary_;
  std::vector<double> areas_; // by loop; negative for holes
  std::vector<std::size_t> outer_;
  std::vector<Enclosure> enclosures_;
  std::vector<std::size_t> of_loop_;
};

} // namespace

void check_choice_of_component(const geometry::Boundary& boundary, const FeatureOptions& options) {
  if (options.components == Components::all)
    return;
  if (boundary.periods.any())
    throw ConfigError("meshing.components: one component can be chosen only in a container that is not periodic; "
                      "expected all");
  const Vec2 p = options.component_place;
  if (options.components == Components::at &&
      ComponentFinder(boundary, std::vector<char>(boundary.loops.size())).holding(p) == ComponentFinder::none)
    throw GeometryError(fmt::format("meshing.components = at: the place {} lies outside of the shape; "
                                    "expected a place in the component that is to be meshed",
                                    Place(p)));
}

void drop_other_components(const geometry::Boundary& boundary, const FeatureRule& rule, DroppedLoops& dropped) {
  if (rule.components == Components::all || boundary.periods.any())
    return;
  const ComponentFinder finder(boundary, dropped.dropped);
  std::size_t chosen = rule.components == Components::largest ? finder.largest() : finder.holding(rule.place);
  if (chosen == ComponentFinder::none)
    chosen = finder.nearest(rule.place);
  for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
    if (dropped.dropped[k] || finder.component_of(k) == chosen)
      continue;
    const double area = enclosed_area(boundary.loops[k]);
    dropped.dropped[k] = 1;
    dropped.other_loops.push_back(boundary.loops[k]);
    dropped.others += boundary.loops[k].outer;
    dropped.others_area += area;
    dropped.change -= area;
  }
}

bool lies_within(std::span<const Loop> loops, Vec2 p) {
  return std::count_if(loops.begin(), loops.end(), [p](const Loop& loop) { return Enclosure(loop).contains(p); }) % 2;
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
