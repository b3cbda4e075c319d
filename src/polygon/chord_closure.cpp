// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/chord_closure.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <array>

namespace trime::polygon {

using geometry::Box;
using geometry::Segment;
using geometry::Vec2;

namespace {

std::vector<Vec2> loose_ends(const std::vector<Segment>& segments) {
  std::vector<Vec2> ends, loose;
  for (const Segment& s : segments)
    ends.insert(ends.end(), {s.a, s.b});
  std::sort(ends.begin(), ends.end(), geometry::lexicographically_less);
  for (std::size_t k = 0, next = 0; k < ends.size(); k = next) {
    while (next < ends.size() && ends[next] == ends[k])
      ++next;
    if ((next - k) % 2 == 1)
      loose.push_back(ends[k]);
  }
  return loose;
}

/// A place on the rectangle that leads around: its side (from the lower one counter-clockwise) and how far along.
struct Landing {
  int side;
  double along;
  Vec2 position;
};

/// Straight away from the window.
Landing land(Vec2 p, const Box& window, const Box& around) {
  if (p.x < window.min.x)
    return {3, -p.y, {around.min.x, p.y}};
  if (p.x > window.max.x)
    return {1, p.y, {around.max.x, p.y}};
  TRIME_ASSERT(p.y < window.min.y || p.y > window.max.y, "a loose end at ({}, {}) inside the window", p.x, p.y);
  if (p.y < window.min.y)
    return {0, p.x, {p.x, around.min.y}};
  return {2, -p.x, {p.x, around.max.y}};
}

} // namespace

std::vector<Segment> close_outside(std::vector<Segment> segments, const Box& window, double margin) {
  Box around;
  for (const Segment& s : segments) {
    around.include(s.a);
    around.include(s.b);
  }
  around = {around.min - Vec2{margin, margin}, around.max + Vec2{margin, margin}};
  std::vector<Landing> landings;
  for (const Vec2 p : loose_ends(segments)) {
    landings.push_back(land(p, window, around));
    segments.push_back({p, landings.back().position});
  }
  std::sort(landings.begin(), landings.end(),
            [](const Landing& a, const Landing& b) { return a.side != b.side ? a.side < b.side : a.along < b.along; });
  // The corner at the end of each side.
  const std::array<Vec2, 4> corners{Vec2{around.max.x, around.min.y}, around.max, Vec2{around.min.x, around.max.y},
                                    around.min};
  for (std::size_t k = 0; k + 1 < landings.size(); k += 2) {
    Vec2 at = landings[k].position;
    for (int side = landings[k].side; side < landings[k + 1].side; ++side) {
      segments.push_back({at, corners[static_cast<std::size_t>(side)]});
      at = corners[static_cast<std::size_t>(side)];
    }
    if (at != landings[k + 1].position)
      segments.push_back({at, landings[k + 1].position});
  }
  return segments;
}

} // namespace trime::polygon
