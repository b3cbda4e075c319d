// SPDX-License-Identifier: BSD-3-Clause
#include "tracing/curve_refiner.hpp"
#include "tracing/rules.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::tracing {
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
