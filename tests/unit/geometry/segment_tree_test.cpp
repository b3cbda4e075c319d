// SPDX-License-Identifier: BSD-3-Clause
// SegmentTree: what meets a segment is found, and among long thin spikes few others are looked at.
#include "geometry/segment_tree.hpp"

#include "core/angle.hpp"
#include "core/random.hpp"
#include "geometry/predicates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace trime::geometry {
namespace {

double uniform(std::uint64_t key, std::uint64_t slot) {
  return random_unit(17, RandomPurpose::test, key, slot);
}

bool cross_each_other(const Segment& s, const Segment& t) {
  return orient2d(s.a, s.b, t.a) * orient2d(s.a, s.b, t.b) <= 0 &&
         orient2d(t.a, t.b, s.a) * orient2d(t.a, t.b, s.b) <= 0;
}

TEST(SegmentTree, FindsWhatMeets) {
  std::vector<Segment> segments;
  for (std::uint64_t k = 0; k < 600; ++k) {
    const Vec2 a{uniform(k, 0), uniform(k, 1)};
    const double size = k % 3 == 0 ? 0.5 : 0.02, angle = 2 * pi * uniform(k, 2);
    segments.push_back({a, k % 50 == 0 ? a : a + Vec2{size * std::cos(angle), size * std::sin(angle)}});
  }
  segments.push_back({segments[7].b, segments[9].a}); // meets both in an end
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{3}, segments.size()}) {
    const std::vector<Segment> some(segments.end() - static_cast<std::ptrdiff_t>(n), segments.end());
    const SegmentTree tree(some);
    for (const Segment& s : segments) {
      std::multiset<LocalIndex> found;
      tree.for_each_near(s, [&](LocalIndex k) {
        found.insert(k);
        return true;
      });
      for (std::size_t k = 0; k < some.size(); ++k) {
        EXPECT_LE(found.count(static_cast<LocalIndex>(k)), 1u);
        if (s.a != s.b && some[k].a != some[k].b && cross_each_other(s, some[k])) {
          EXPECT_EQ(found.count(static_cast<LocalIndex>(k)), 1u);
        }
      }
    }
  }
}

TEST(SegmentTree, FindsWhatIsNearerThanItsMargin) {
  std::vector<Segment> segments;
  for (int k = 0; k < 40; ++k)
    segments.push_back({{0.1 * k, 0}, {0.1 * k + 1, 1}});
  const auto finds = [](const SegmentTree& tree, const Segment& s, LocalIndex index) {
    bool found = false;
    tree.for_each_near(s, [&](LocalIndex k) {
      found |= k == index;
      return true;
    });
    return found;
  };
  const SegmentTree tree(segments, 0.01);
  for (LocalIndex k = 0; k < 40; ++k) { // beside the middle of one, at 0.0085 and at 0.028
    const Segment& s = segments[static_cast<std::size_t>(k)];
    const Vec2 p = s.a + 0.5 * (s.b - s.a);
    const Segment near{p + Vec2{0.006, -0.006}, p + Vec2{0.007, -0.007}};
    const Segment far{p + Vec2{0.02, -0.02}, p + Vec2{0.025, -0.025}};
    const SegmentTree alone({&s, 1}, 0.01), narrow({&s, 1});
    EXPECT_TRUE(finds(tree, near, k));
    EXPECT_TRUE(finds(alone, near, 0));
    EXPECT_FALSE(finds(alone, far, 0));
    EXPECT_FALSE(finds(narrow, near, 0));
  }
}

TEST(SegmentTree, StopsWhenItIsTold) {
  std::vector<Segment> segments(100, {{0, 0}, {1, 1}});
  const SegmentTree tree(segments);
  int visits = 0;
  tree.for_each_near({{0, 1}, {1, 0}}, [&](LocalIndex) { return ++visits < 7; });
  EXPECT_EQ(visits, 7);
}

/// Visits of all segments by themselves.
std::size_t visits(const std::vector<Segment>& segments) {
  const SegmentTree tree(segments);
  std::size_t count = 0;
  for (const Segment& s : segments)
    tree.for_each_near(s, [&](LocalIndex) {
      ++count;
      return true;
    });
  return count;
}

std::vector<Segment> closed(const std::vector<Vec2>& points) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < points.size(); ++k)
    segments.push_back({points[k], points[(k + 1) % points.size()]});
  return segments;
}

TEST(SegmentTree, LongThinSpikesLookAtFewOthers) {
  constexpr int spikes = 3000;
  for (const double turn : {0.0, 0.25 * pi, 0.3}) {
    std::vector<Vec2> comb, star;
    for (int k = 0; k < spikes; ++k)
      for (const auto& [u, v] : {std::pair{k + 0.0, 0.0}, std::pair{k + 0.5, 1.0 * spikes}}) {
        comb.push_back({std::cos(turn) * u - std::sin(turn) * v, std::sin(turn) * u + std::cos(turn) * v});
        const double angle = 2 * pi * u / spikes + turn, r = v > 0 ? 0.9 : 0.4;
        star.push_back({r * std::cos(angle), r * std::sin(angle)});
      }
    EXPECT_LT(visits(closed(comb)), std::size_t{30} * 2 * spikes);
    EXPECT_LT(visits(closed(star)), std::size_t{30} * 2 * spikes);
  }
}

} // namespace
} // namespace trime::geometry
