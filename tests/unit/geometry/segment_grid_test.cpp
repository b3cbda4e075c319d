// SPDX-License-Identifier: BSD-3-Clause
// SegmentGrid against brute force: parity with the same symbolic perturbation, nearest segments, box queries.
#include "trime/geometry/segment_grid.hpp"

#include "core/random.hpp"
#include "geometry/predicates.hpp"
#include "trime/geometry/lattice.hpp"

#include <gtest/gtest.h>

#include <set>

namespace trime::geometry {
namespace {

const Lattice lattice(Box{{0, 0}, {1, 1}});

double uniform(std::uint64_t key, std::uint64_t slot) {
  return random_unit(7, RandomPurpose::test, key, slot);
}

/// Parity along the whole perturbed ray to the left: an independent road to the same definition.
bool inside_by_ray(const std::vector<Segment>& segments, Vec2 p) {
  bool parity = false;
  for (const Segment& s : segments) {
    if ((s.a.y > p.y) == (s.b.y > p.y))
      continue;
    const Vec2 low = s.a.y < s.b.y ? s.a : s.b, high = s.a.y < s.b.y ? s.b : s.a;
    int side = orient2d(low, high, p);
    if (side == 0)
      side = high.x > low.x ? 1 : -1; // moved up by epsilon; a vertical segment: moved right by epsilon^2
    parity ^= side < 0;
  }
  return parity;
}

SegmentGrid::Nearest nearest_by_scan(const std::vector<Segment>& segments, Vec2 p) {
  SegmentGrid::Nearest best{0, squared_distance(p, segments[0])};
  for (std::size_t k = 1; k < segments.size(); ++k)
    if (const double d = squared_distance(p, segments[k]); d < best.squared_distance)
      best = {static_cast<LocalIndex>(k), d};
  return best;
}

void add_polygon(std::vector<Segment>& segments, const std::vector<Vec2>& polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    segments.push_back({polygon[k], polygon[(k + 1) % polygon.size()]});
}

std::vector<Vec2> star(Vec2 center, double radius, int n, std::uint64_t key) {
  std::vector<Vec2> polygon;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * 3.14159265358979 * k / n, r = radius * (0.3 + 0.7 * uniform(key, k));
    polygon.push_back(lattice.snap(Vec2{center.x + r * std::cos(angle), center.y + r * std::sin(angle)}));
  }
  return polygon;
}

void expect_agreement(const std::vector<Segment>& segments, const std::vector<Vec2>& queries) {
  const SegmentGrid grid(segments);
  for (const Vec2 p : queries) {
    ASSERT_EQ(grid.inside(p), inside_by_ray(segments, p)) << p.x << " " << p.y;
    const auto expected = nearest_by_scan(segments, p), found = grid.nearest(p);
    ASSERT_EQ(found.segment, expected.segment) << p.x << " " << p.y;
    ASSERT_EQ(found.squared_distance, expected.squared_distance);
    for (const double reach : {0.0, 1e-9, 1e-3}) {
      std::set<LocalIndex> seen;
      grid.for_each_near(Box{{p.x - reach, p.y - reach}, {p.x + reach, p.y + reach}},
                         [&](LocalIndex index) { return seen.insert(index), true; });
      for (std::size_t s = 0; s < segments.size(); ++s)
        ASSERT_TRUE(squared_distance(p, segments[s]) > reach * reach || seen.count(static_cast<LocalIndex>(s)))
            << p.x << " " << p.y << " within " << reach;
    }
  }
}

TEST(SegmentGrid, AgreesWithBruteForceOnStarsWithHoles) {
  for (int n : {3, 7, 40, 500}) {
    std::vector<Segment> segments;
    add_polygon(segments, star({0.3, 0.3}, 0.25, n, 1));
    add_polygon(segments, star({0.3, 0.3}, 0.05, n, 2));
    add_polygon(segments, star({0.75, 0.7}, 0.2, 2 * n, 3));
    std::vector<Vec2> queries;
    for (int k = 0; k < 400; ++k)
      queries.push_back(lattice.snap(Vec2{uniform(100 + n, 2 * k), uniform(100 + n, 2 * k + 1)}));
    for (const Segment& s : segments)
      queries.push_back(s.a);
    expect_agreement(segments, queries);
  }
}

TEST(SegmentGrid, AgreesWithBruteForceOnIntegerGridPolygons) {
  // Unions of random lattice squares drawn edge by edge: collinear edges, shared corners, doubled edges.
  for (int round = 0; round < 10; ++round) {
    std::vector<Segment> segments;
    for (int k = 0; k < 30; ++k) {
      const double x = std::floor(16 * uniform(200 + round, 4 * k)),
                   y = std::floor(16 * uniform(200 + round, 4 * k + 1));
      const double w = 1 + std::floor(4 * uniform(200 + round, 4 * k + 2));
      if (k % 3 == 0)
        add_polygon(segments, {{x, y}, {x + w, y}, {x, y + w}});
      else
        add_polygon(segments, {{x, y}, {x + w, y}, {x + w, y + w}, {x, y + w}});
    }
    const SegmentGrid grid(segments);
    for (int j = -2; j <= 44; ++j)
      for (int i = -2; i <= 44; ++i) {
        const Vec2 p{0.5 * i, 0.5 * j};
        ASSERT_EQ(grid.inside(p), inside_by_ray(segments, p)) << p.x << " " << p.y;
      }
  }
}

TEST(SegmentGrid, UnitSquareOwnsLowerLeftButNotUpperRight) {
  std::vector<Segment> segments;
  add_polygon(segments, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const SegmentGrid grid(segments);
  EXPECT_TRUE(grid.inside({0, 0}));
  EXPECT_TRUE(grid.inside({0.5, 0}));
  EXPECT_TRUE(grid.inside({0, 0.5}));
  EXPECT_FALSE(grid.inside({1, 0}));
  EXPECT_FALSE(grid.inside({0.5, 1}));
  EXPECT_FALSE(grid.inside({1, 0.5}));
  EXPECT_FALSE(grid.inside({-1, 0.5}));
}

TEST(SegmentGrid, FarFromTheOriginAndVeryThin) {
  // One lattice step high, at coordinates where a double has just that resolution.
  const double step = 0x1p-20, x0 = 0x1p31;
  std::vector<Segment> segments;
  add_polygon(segments, {{x0, x0}, {x0 + 64, x0}, {x0 + 64, x0 + step}, {x0, x0 + step}});
  std::vector<Vec2> queries;
  for (int k = -2; k <= 66; ++k)
    for (int j = -2; j <= 3; ++j)
      queries.push_back({x0 + k, x0 + j * step});
  expect_agreement(segments, queries);
}

TEST(SegmentGrid, ManySegmentsAtOnePointAndCombsStaySmall) {
  std::vector<Segment> fan, comb;
  const Vec2 center = lattice.snap(Vec2{0.4, 0.6});
  const std::vector<Vec2> rim = star(center, 0.3, 2000, 5);
  for (std::size_t k = 0; k + 1 < rim.size(); k += 2)
    add_polygon(fan, {center, rim[k], rim[k + 1]});
  std::vector<Vec2> teeth{{0, 1}, {0, 0}};
  for (int k = 0; k < 2000; ++k)
    teeth.push_back(lattice.snap(Vec2{(k + 1) / 2001.0, k % 2 ? 0.01 : 0.99}));
  add_polygon(comb, teeth);
  std::vector<Vec2> queries{center};
  for (int k = 0; k < 200; ++k)
    queries.push_back(lattice.snap(Vec2{uniform(300, 2 * k), uniform(300, 2 * k + 1)}));
  expect_agreement(fan, queries);
  expect_agreement(comb, queries);
  EXPECT_LT(SegmentGrid(fan).memory_bytes(), 1000 * fan.size());
  EXPECT_LT(SegmentGrid(comb).memory_bytes(), 1000 * comb.size());
}

TEST(SegmentGrid, LongSegmentsPassThroughTheSmallestCells) {
  // A tiny dense circle on the edge of a long triangle: cells 2^-30 of the length of its segments.
  std::vector<Segment> segments;
  const Vec2 center = lattice.snap(Vec2{0.123, 0.5});
  add_polygon(segments, {{0, 0.5}, {1, 0.5}, {0.5, 1}});
  add_polygon(segments, star(center, 1e-9, 300, 8));
  std::vector<Vec2> queries;
  for (int k = 0; k < 500; ++k)
    queries.push_back(lattice.snap(
        Vec2{center.x + 2.4e-9 * (uniform(500, 2 * k) - 0.5), center.y + 2.4e-9 * (uniform(500, 2 * k + 1) - 0.5)}));
  expect_agreement(segments, queries);
}

TEST(SegmentGrid, NearestWithinReachAndBoxQueries) {
  std::vector<Segment> segments;
  add_polygon(segments, star({0.5, 0.5}, 0.4, 300, 6));
  const SegmentGrid grid(segments);
  for (int k = 0; k < 300; ++k) {
    const Vec2 p{1.4 * uniform(400, 3 * k) - 0.2, 1.4 * uniform(400, 3 * k + 1) - 0.2};
    const double reach = 0.2 * uniform(400, 3 * k + 2);
    const auto expected = nearest_by_scan(segments, p);
    const auto found = grid.nearest(p, reach);
    ASSERT_EQ(found.has_value(), expected.squared_distance <= reach * reach);
    if (found) {
      ASSERT_EQ(found->segment, expected.segment);
    }
    const Box box{{p.x - reach, p.y - reach}, {p.x + reach, p.y + reach}};
    std::set<LocalIndex> seen;
    grid.for_each_near(box, [&](LocalIndex index) { return seen.insert(index), true; });
    for (std::size_t s = 0; s < segments.size(); ++s)
      if (box.contains(segments[s].a) || squared_distance(p, segments[s]) <= reach * reach) {
        ASSERT_TRUE(seen.count(static_cast<LocalIndex>(s)));
      }
  }
}

TEST(SegmentGrid, EmptyGridAnswers) {
  const SegmentGrid grid;
  EXPECT_FALSE(grid.inside({0, 0}));
  EXPECT_FALSE(grid.nearest({0, 0}, 1).has_value());
  grid.for_each_near(Box{{0, 0}, {1, 1}}, [](LocalIndex) {
    ADD_FAILURE();
    return true;
  });
}

/// What comes near a slanted segment is found, and less is looked at than in its box.
TEST(SegmentGrid, ASlantedSegmentLooksAlongItself) {
  constexpr int count = 500;
  std::vector<Segment> chords;
  for (std::uint64_t k = 0; k < count; ++k) {
    const Vec2 a{uniform(k, 1), uniform(k, 2)};
    chords.push_back({lattice.snap(a), lattice.snap(a + 0.02 * Vec2{uniform(k, 3), uniform(k, 4)})});
  }
  const SegmentGrid grid(chords);
  const double margin = 1e-3;
  for (const Segment& s : {Segment{{0.1, 0.2}, {0.9, 0.8}}, Segment{{0.2, 0.9}, {0.7, 0.1}}}) {
    Box box;
    for (const Vec2 p : {s.a, s.b}) {
      box.include(p - Vec2{margin, margin});
      box.include(p + Vec2{margin, margin});
    }
    std::set<LocalIndex> found, in_box;
    const auto into = [](std::set<LocalIndex>& set) {
      return [&set](LocalIndex k) {
        set.insert(k);
        return true;
      };
    };
    grid.for_each_near(box, s, margin, into(found));
    grid.for_each_near(box, into(in_box));
    EXPECT_LT(4 * found.size(), in_box.size());
    for (LocalIndex k = 0; k < count; ++k)
      if (const Segment& t = chords[static_cast<std::size_t>(k)];
          squared_distance(t.a, s) <= margin * margin || squared_distance(t.b, s) <= margin * margin) {
        EXPECT_TRUE(found.contains(k));
      }
  }
}

TEST(SegmentGrid, SegmentsThatMeetAreTogetherInABin) {
  std::vector<Segment> segments;
  for (std::uint64_t k = 0; k < 8; ++k) // stars that cross each other, and a vertex on a corner of cells
    add_polygon(segments, star({0.3 + 0.05 * static_cast<double>(k), 0.5}, 0.25, 60, 100 + k));
  add_polygon(segments, {{0.5, 0.5}, {0.75, 0.5}, {0.5, 0.75}});
  const SegmentGrid grid(segments);
  std::set<std::pair<LocalIndex, LocalIndex>> together;
  for (std::size_t bin = 0; bin < grid.bins(); ++bin)
    for (const LocalIndex a : grid.bin(bin))
      for (const LocalIndex b : grid.bin(bin))
        together.insert({a, b});
  std::size_t meetings = 0;
  for (LocalIndex a = 0; a < std::ssize(segments); ++a)
    for (LocalIndex b = 0; b < std::ssize(segments); ++b) {
      const Segment &s = segments[at(a)], &t = segments[at(b)];
      if (orient2d(s.a, s.b, t.a) * orient2d(s.a, s.b, t.b) > 0 ||
          orient2d(t.a, t.b, s.a) * orient2d(t.a, t.b, s.b) > 0)
        continue;
      if (a != b && orient2d(s.a, s.b, t.a) == 0 && orient2d(s.a, s.b, t.b) == 0 && s.a != t.b && s.b != t.a)
        continue; // on one line, perhaps apart
      ++meetings;
      EXPECT_TRUE(together.count({a, b})) << a << ' ' << b;
    }
  EXPECT_GT(meetings, segments.size() * 4);
}

} // namespace
} // namespace trime::geometry
