// SPDX-License-Identifier: BSD-3-Clause
#include "tracing/curve_refiner.hpp"

#include "tracing/rules.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace trime::tracing {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::length;
using geometry::squared_length;
using geometry::Vec2;

// [rad] Corners are looked for where two chords turn by more than this, about 4 degrees.
constexpr double smallest_turn = 0.07;
constexpr int deepest_chord = 48;           // [halvings] A chord is halved so often at most
constexpr std::size_t most_in_chord = 4096; // [vertices] Largest number in one chord, before thinning
// [vertices] Largest number for a formula, before thinning: it bounds the memory.
constexpr std::size_t most_vertices = std::size_t{1} << 23;
// [chords] Distance from the middle of a chord up to which the curve is searched: it may be far in a sharp tip.
constexpr double farthest_beside = 16;
constexpr double farthest_corner = 64;   // [chords] A corner is looked for so far from its chord at most
constexpr double nearer = 0.125;         // Each look at the arms of a supposed corner is so much nearer than the last
constexpr double nearly_parallel = 1e-3; // Lines whose directions differ by a smaller sine do not meet
// Vertices of a traced curve so near to each other are one, as a share of the longer side.
constexpr double same_place = 1e-9;

Vec2 unit(Vec2 v) {
  return (1 / length(v)) * v;
}

/// Does the direction turn by more than smallest_turn from u to v?
bool turns(Vec2 u, Vec2 v) {
  const double lengths = std::sqrt(squared_length(u) * squared_length(v));
  return dot(u, v) < (1 - 0.5 * smallest_turn * smallest_turn) * lengths;
}

/// The point with p + s u = q + t v; nothing if the directions nearly agree.
std::optional<Vec2> meeting(Vec2 p, Vec2 u, Vec2 q, Vec2 v) {
  const double determinant = cross(u, v);
  if (std::fabs(determinant) < nearly_parallel * std::sqrt(squared_length(u) * squared_length(v)))
    return std::nullopt;
  return p + (cross(q - p, v) / determinant) * u;
}

} // namespace

std::vector<Vec2> CurveRefiner::refine(const std::vector<Vec2>& chain) {
  return thinned(insert_corners(halve_chords(chain)), tolerances_.straight, 2 * tolerances_.chord);
}

/// In batches of a fixed size, so that a curve that cannot be followed ends soon, and at the same chord for any number
/// of threads.
std::vector<Vec2> CurveRefiner::halve_chords(const std::vector<Vec2>& chain) {
  constexpr std::size_t batch = 64;
  std::vector<Vec2> all;
  for (std::size_t first = 0; first < chain.size(); first += batch) {
    std::vector<std::vector<Vec2>> parts(std::min(batch, chain.size() - first));
    std::vector<std::uint8_t> followed(parts.size());
    function_.for_all(parts.size(), 1, [&](std::size_t k) {
      const Vec2 a = chain[first + k], b = chain[(first + k + 1) % chain.size()];
      parts[k].push_back(a);
      followed[k] = halve(a, b, 0, parts[k]);
    });
    for (std::size_t k = 0; k < parts.size(); ++k) {
      vertices_ += parts[k].size();
      if (!followed[k] || vertices_ > most_vertices)
        fail_for_oscillation(chain[first + k], !followed[k] ? most_in_chord : most_vertices);
      all.insert(all.end(), parts[k].begin(), parts[k].end());
    }
  }
  return all;
}

/// Appends the vertices strictly between a and b. False if they would be too many; stops where they come no
/// nearer, as in the tip of a wedge, whose curve may lie many chords away.
bool CurveRefiner::halve(Vec2 a, Vec2 b, int depth, std::vector<Vec2>& to) const {
  if (depth == deepest_chord || length(b - a) < tolerances_.shortest || is_near(a, b))
    return true;
  if (to.size() >= most_in_chord)
    return false;
  const std::optional<Vec2> middle = curve_beside(a, b);
  if (!middle)
    return true;
  if (!halve(a, *middle, depth + 1, to))
    return false;
  to.push_back(*middle);
  return halve(*middle, b, depth + 1, to);
}

void CurveRefiner::fail_for_oscillation(Vec2 place, std::size_t vertices) const {
  throw GeometryError(fmt::format(
      "part '{}': the function oscillates below the resolution of {:.3g} near ({:.9g}, {:.9g}): its zeros could not be "
      "followed with {} vertices; leave out the details of the formula that are smaller than the resolution",
      function_.name(), resolution_, place.x, place.y, vertices));
}

/// Does the curve pass the chord within the tolerance, at three places?
bool CurveRefiner::is_near(Vec2 a, Vec2 b) const {
  const double whole = length(b - a), allowed = std::fmin(tolerances_.chord, TracingRules::stray_share * whole);
  const Vec2 outward = (-allowed / whole) * left_normal(b - a);
  for (const double t : {0.5, 0.25, 0.75}) {
    const Vec2 p = a + t * (b - a);
    if (function_.inside(p + outward) || !function_.inside(p - outward))
      return false;
  }
  return true;
}

/// The nearest zero on the bisector of the chord, on the side where it must lie; it may be far in a sharp tip.
std::optional<Vec2> CurveRefiner::curve_beside(Vec2 a, Vec2 b) const {
  const Vec2 p = a + 0.5 * (b - a);
  const double value = function_(p), whole = length(b - a);
  const Vec2 direction = (value < 0 ? -1 : 1) * left_normal((1 / whole) * (b - a));
  double from = 0, from_value = value;
  for (double to = 0.125 * tolerances_.chord; to < farthest_beside * whole; to = std::fmin(2 * to, to + 0.25 * whole)) {
    const double to_value = function_(p + to * direction);
    if ((to_value < 0) != (value < 0))
      return function_.crossing(p + from * direction, from_value, p + to * direction, to_value, tolerances_.zero);
    from = to;
    from_value = to_value;
  }
  return std::nullopt;
}

/// Corners lie within a chord, or at a vertex that hit one by luck.
std::vector<CurveVertex> CurveRefiner::insert_corners(const std::vector<Vec2>& polygon) const {
  struct Found {
    std::optional<Vec2> at, after; // at vertex k, or between it and the next one
  };
  const std::size_t n = polygon.size();
  std::vector<Found> found(n);
  function_.for_all(n, 16, [&](std::size_t k) {
    const Vec2 before = polygon[(k + n - 1) % n], a = polygon[k], b = polygon[(k + 1) % n],
               after = polygon[(k + 2) % n];
    if (turns(a - before, b - a))
      found[k].at = corner_at(a, unit(before - a), unit(b - a), 0.25 * std::fmin(length(a - before), length(b - a)));
    if (turns(a - before, after - b))
      found[k].after = corner_in_chord(before, a, b, after);
  });
  std::vector<CurveVertex> result;
  const double same = same_place * tolerances_.side;
  const auto add = [&](Vec2 p, bool corner) {
    if (!result.empty() && length(p - result.back().place) < same) {
      if (corner && !result.back().keep)
        result.back() = {p, true};
      return;
    }
    result.push_back({p, corner});
  };
  for (std::size_t k = 0; k < n; ++k) {
    add(found[k].at.value_or(polygon[k]), found[k].at.has_value());
    if (found[k].after)
      add(*found[k].after, true);
  }
  while (result.size() > 1 && length(result.back().place - result.front().place) < same) {
    if (result.back().keep)
      result.front() = result.back();
    result.pop_back();
  }
  return result;
}

/// The lines of the chords before and after meet where the corner is to be looked for.
std::optional<Vec2> CurveRefiner::corner_in_chord(Vec2 before, Vec2 a, Vec2 b, Vec2 after) const {
  const std::optional<Vec2> guess = meeting(a, a - before, b, after - b);
  if (!guess)
    return std::nullopt;
  const double reach = std::fmax(length(*guess - a), length(*guess - b)), whole = length(b - a);
  if (reach > farthest_corner * whole)
    return std::nullopt;
  const std::optional<Vec2> corner = corner_at(*guess, unit(before - a), unit(after - b), reach);
  const double same = same_place * tolerances_.side;
  const bool between =
      corner && dot(*corner - a, unit(a - before)) > -same && dot(b - *corner, unit(after - b)) > -same;
  return between ? corner : std::nullopt;
}

/// @brief Looks at both arms of a supposed corner, nearer and nearer: at a corner the lines
/// through the arms keep meeting at an angle; where the curve is smooth they run past it.
/// @param back,ahead unit directions from the corner along the arm before it and the one after it
std::optional<Vec2> CurveRefiner::corner_at(Vec2 guess, Vec2 back, Vec2 ahead, double distance) const {
  for (double d = std::fmax(distance, tolerances_.corner);; d = std::fmax(nearer * d, tolerances_.corner)) {
    const auto back_near = on_arm(guess + d * back, -1 * back, d),
               back_far = on_arm(guess + 2 * d * back, -1 * back, d);
    const auto ahead_near = on_arm(guess + d * ahead, ahead, d), ahead_far = on_arm(guess + 2 * d * ahead, ahead, d);
    if (!back_near || !back_far || !ahead_near || !ahead_far)
      return std::nullopt;
    back = unit(*back_far - *back_near);
    ahead = unit(*ahead_far - *ahead_near);
    const std::optional<Vec2> corner = meeting(*back_near, back, *ahead_near, ahead);
    if (!corner || length(*corner - guess) > d || !turns(-1 * back, ahead))
      return std::nullopt;
    guess = *corner;
    if (d <= tolerances_.corner)
      return guess;
  }
}

/// The curve across a point near it, if it runs in the direction `along` there, interior on the left.
std::optional<Vec2> CurveRefiner::on_arm(Vec2 near, Vec2 along, double distance) const {
  for (const double window : {0.25, 1.0 / 16, 1.0 / 64, 1.0 / 256}) { // the other arm may be near, too
    const Vec2 outward = (-window * distance) * left_normal(along);
    const Vec2 a = near - outward, b = near + outward;
    const double value_a = function_(a), value_b = function_(b);
    if (value_a < 0 && value_b >= 0)
      return function_.crossing(a, value_a, b, value_b, tolerances_.zero);
  }
  return std::nullopt;
}

namespace {

using geometry::dot;
using geometry::length;
using geometry::Segment;
using geometry::squared_distance;
using geometry::squared_length;
using geometry::Vec2;

using Vertices = std::vector<CurveVertex>;

bool is_straight(const Vertices& v, std::size_t first, std::size_t last, double stray) {
  const Segment chord{v[first].place, v[last].place};
  for (std::size_t k = first + 1; k < last; ++k)
    if (squared_distance(v[k].place, chord) > stray * stray)
      return false;
  return true;
}

/// The vertex to start at: a corner, else the one with the sharpest turn, which lies on no straight side.
std::size_t start_of(const Vertices& v) {
  std::size_t best = 0;
  double least = 2;
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (v[k].keep)
      return k;
    const Vec2 in = v[k].place - v[(k + v.size() - 1) % v.size()].place, out = v[(k + 1) % v.size()].place - v[k].place;
    const double cosine = dot(in, out) / (length(in) * length(out));
    if (cosine < least) {
      least = cosine;
      best = k;
    }
  }
  return best;
}

/// Joins the vertices of each straight run, and keeps the ends of those that replace many.
Vertices join_runs(const Vertices& v, double stray) {
  constexpr std::size_t many = 4, longest = 4096; // the second bounds the time, which is quadratic in it
  Vertices joined{v.front()};
  for (std::size_t first = 0; first + 1 < v.size();) {
    std::size_t last = first + 1;
    while (last + 1 < v.size() && !v[last].keep && last - first < longest && is_straight(v, first, last + 1, stray))
      ++last;
    const bool long_run = last - first >= many;
    joined.back().keep = joined.back().keep || long_run;
    joined.push_back(v[last]);
    joined.back().keep = joined.back().keep || long_run;
    first = last;
  }
  return joined;
}

/// Chords between first and last that leave no vertex farther than `stray` (Douglas and Peucker); marks who stays.
void keep_outlines(Vertices& v, std::size_t first, std::size_t last, double stray) {
  std::vector<std::array<std::size_t, 2>> stretches{{first, last}};
  while (!stretches.empty()) {
    const auto [a, b] = stretches.back();
    stretches.pop_back();
    const Segment chord{v[a].place, v[b].place};
    double farthest = 0;
    std::size_t where = a;
    for (std::size_t k = a + 1; k < b; ++k)
      if (const double d = squared_distance(v[k].place, chord); d > farthest) {
        farthest = d;
        where = k;
      }
    const double allowed = std::fmin(stray, TracingRules::stray_share * length(chord.b - chord.a));
    if (where == a || farthest <= allowed * allowed)
      continue;
    v[where].keep = true;
    stretches.push_back({a, where});
    stretches.push_back({where, b});
  }
}

} // namespace

std::vector<Vec2> thinned(std::vector<CurveVertex> polygon, double straight, double chord) {
  std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(start_of(polygon)), polygon.end());
  polygon.push_back(polygon.front());
  Vertices v = join_runs(polygon, straight);
  v.front().keep = v.back().keep = true;
  if (std::none_of(v.begin() + 1, v.end() - 1, [](const CurveVertex& vertex) { return vertex.keep; })) {
    const auto nearer = [&](const CurveVertex& a, const CurveVertex& b) {
      return squared_length(a.place - v[0].place) < squared_length(b.place - v[0].place);
    };
    std::max_element(v.begin(), v.end(), nearer)->keep = true;
  }
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < v.size(); ++k)
    if (v[k].keep)
      kept.push_back(k);
  for (std::size_t k = 0; k + 1 < kept.size(); ++k)
    keep_outlines(v, kept[k], kept[k + 1], chord);
  std::vector<Vec2> result;
  for (std::size_t k = 0; k + 1 < v.size(); ++k)
    if (v[k].keep)
      result.push_back(v[k].place);
  return result;
}

} // namespace trime::tracing
