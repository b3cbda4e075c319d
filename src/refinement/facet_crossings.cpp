// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/facet_crossings.hpp"

#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"
#include "geometry/segment_tree.hpp"

#include <algorithm>

namespace trime::refinement {

using geometry::orient2d;
using geometry::Segment;
using geometry::Vec2;

namespace {

bool overlap(double a, double b, double c, double d) {
  return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

/// Do closed segments have a point in common?
bool meet(const Segment& s, const Segment& t) {
  return overlap(s.a.x, s.b.x, t.a.x, t.b.x) && overlap(s.a.y, s.b.y, t.a.y, t.b.y) &&
         orient2d(s.a, s.b, t.a) * orient2d(s.a, s.b, t.b) <= 0 &&
         orient2d(t.a, t.b, s.a) * orient2d(t.a, t.b, s.b) <= 0;
}

bool share_an_end(const Segment& s, const Segment& t) {
  return s.a == t.a || s.a == t.b || s.b == t.a || s.b == t.b;
}

} // namespace

std::vector<std::size_t> crossing(std::span<const Segment> all, std::span<const Segment> tried,
                                  const geometry::Periods& periods) {
  const geometry::SegmentTree tree(all);
  const auto crosses = [&](const Segment& segment) {
    bool found = false;
    tree.for_each_near(segment, [&](LocalIndex k) {
      const Segment& other = all[at(k)];
      found = !share_an_end(segment, other) && meet(segment, other);
      return !found;
    });
    return found;
  };
  std::vector<char> is_crossing(tried.size(), 0);
  thread_loop(std::ssize(tried), 64, [&](std::ptrdiff_t item, int) {
    const Segment& segment = tried[static_cast<std::size_t>(item)];
    for (const int i : {0, -1, 1})
      for (const int j : {0, -1, 1}) {
        const Vec2 shift{i * periods.x, j * periods.y};
        if ((i == 0 || periods.x > 0) && (j == 0 || periods.y > 0) && crosses({segment.a + shift, segment.b + shift}))
          is_crossing[static_cast<std::size_t>(item)] = 1;
      }
  });
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < is_crossing.size(); ++k)
    if (is_crossing[k])
      found.push_back(k);
  return found;
}

} // namespace trime::refinement
