// SPDX-License-Identifier: BSD-3-Clause
// Checks properties of every boundary, and of a boundary compared with its simplification, by brute force and exactly
// where possible.
#pragma once

#include "geometry/predicates.hpp"
#include "support/boundary_shapes.hpp"
#include "trime/geometry/segment_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace trime::generalise {

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;
using geometry::Segment;
using geometry::Vec2;

/// Returns straight pieces unchanged, and arcs as `parts` chords with ends on the lattice.
inline std::vector<Segment> segments_of(const Loop& loop, int parts = 32) {
  std::vector<Segment> segments;
  for (const Piece& piece : loop.pieces) {
    const int count = piece.circular ? parts : 1;
    Vec2 from = piece.start;
    for (int k = 1; k <= count; ++k) {
      const Vec2 to = k == count ? piece.end : testing::unit_lattice().snap(piece.point(piece.length() * k / count));
      segments.push_back({from, to});
      from = to;
    }
  }
  return segments;
}

inline std::vector<Segment> segments_of(const Boundary& boundary) {
  std::vector<Segment> segments;
  for (const Loop& loop : boundary.loops) {
    const std::vector<Segment> more = segments_of(loop);
    segments.insert(segments.end(), more.begin(), more.end());
  }
  return segments;
}

/// Returns whether two closed segments meet. Common ends count, except if one segment follows the other on a curve.
inline bool meet(const Segment& s, const Segment& t) {
  using geometry::orient2d;
  const int a = orient2d(s.a, s.b, t.a), b = orient2d(s.a, s.b, t.b), c = orient2d(t.a, t.b, s.a),
            d = orient2d(t.a, t.b, s.b);
  if (s.b == t.a || s.a == t.b) { // neighbours, which may also share their other ends
    const Vec2 p = s.b == t.a ? s.a : s.b, middle = s.b == t.a ? s.b : s.a, q = s.b == t.a ? t.b : t.a;
    return p == q || (orient2d(p, middle, q) == 0 && dot(p - middle, q - middle) > 0);
  }
  if (a == 0 && b == 0) {
    const auto within = [](double p, double q, double u, double v) {
      return std::max(std::min(p, q), std::min(u, v)) <= std::min(std::max(p, q), std::max(u, v));
    };
    return within(s.a.x, s.b.x, t.a.x, t.b.x) && within(s.a.y, s.b.y, t.a.y, t.b.y);
  }
  return a * b <= 0 && c * d <= 0;
}

/// Returns the first two segments that meet as text; empty if no two segments meet. Exact. Cost: at worst O(n^2).
inline std::string first_meeting(std::vector<Segment> segments) {
  const auto left = [](const Segment& s) { return std::min(s.a.x, s.b.x); };
  std::sort(segments.begin(), segments.end(), [&](const Segment& s, const Segment& t) { return left(s) < left(t); });
  const auto text = [](const Segment& s) {
    return std::to_string(s.a.x) + " " + std::to_string(s.a.y) + " to " + std::to_string(s.b.x) + " " +
           std::to_string(s.b.y);
  };
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Segment& s = segments[k];
    if (s.a == s.b)
      return "no length: " + text(s);
    const double right = std::max(s.a.x, s.b.x);
    for (std::size_t m = k + 1; m < segments.size() && left(segments[m]) <= right; ++m) {
      const Segment& t = segments[m];
      if (std::max(s.a.y, s.b.y) >= std::min(t.a.y, t.b.y) && std::max(t.a.y, t.b.y) >= std::min(s.a.y, s.b.y) &&
          meet(s, t))
        return text(s) + " meets " + text(t);
    }
  }
  return {};
}

inline double signed_area(const std::vector<Segment>& ring) {
  double area = 0;
  for (const Segment& s : ring)
    area += 0.5 * cross(s.a - ring[0].a, s.b - ring[0].a);
  return area;
}

/// Checks the invariants of Boundary: closed loops that do not touch, orientation by depth of nesting, the area,
/// different tags.
inline void expect_proper(const Boundary& boundary) {
  double area = 0;
  std::set<int> tags;
  std::vector<std::vector<Segment>> rings;
  for (const Loop& loop : boundary.loops) {
    ASSERT_GE(loop.pieces.size(), 2u);
    for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
      ASSERT_EQ(loop.pieces[k].end, loop.pieces[(k + 1) % loop.pieces.size()].start);
      EXPECT_LT(loop.pieces[k].part, static_cast<int>(boundary.part_names.size()));
    }
    EXPECT_TRUE(tags.insert(loop.tag).second) << "tag " << loop.tag << " twice";
    rings.push_back(segments_of(loop));
    double own = signed_area(rings.back());
    EXPECT_EQ(own > 0, loop.outer) << "tag " << loop.tag;
    for (const Piece& piece : loop.pieces)
      if (piece.circular) { // the area between the arc and its chord
        const double step = piece.sweep / 32;
        own += 32 * 0.5 * piece.radius * piece.radius * (step - sin_cos(step).sin);
      }
    area += own;
  }
  EXPECT_NEAR(boundary.area, area, 1e-9);
  EXPECT_EQ(first_meeting(segments_of(boundary)), "");
  for (std::size_t k = 0; k < rings.size(); ++k) {
    int depth = 0;
    for (std::size_t m = 0; m < rings.size(); ++m)
      if (m != k)
        depth += geometry::SegmentGrid(rings[m]).inside(rings[k][0].a);
    EXPECT_EQ(depth % 2 == 0, boundary.loops[k].outer) << "tag " << boundary.loops[k].tag;
  }
}

/// Returns the vertices that the user wants to keep as corners.
inline std::set<std::pair<double, double>> corners_of(const Boundary& boundary) {
  std::set<std::pair<double, double>> corners;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      if (piece.corner)
        corners.insert({piece.start.x, piece.start.y});
  return corners;
}

inline bool are_equal(const Piece& a, const Piece& b) {
  return a.start == b.start && a.end == b.end && a.circular == b.circular && a.corner == b.corner && a.part == b.part &&
         a.center == b.center && a.radius == b.radius && a.start_angle == b.start_angle && a.sweep == b.sweep;
}

inline bool are_equal(const Loop& a, const Loop& b) {
  return a.outer == b.outer && a.tag == b.tag && a.pieces.size() == b.pieces.size() &&
         std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(),
                    [](const Piece& p, const Piece& q) { return are_equal(p, q); });
}

inline bool are_equal(const Boundary& a, const Boundary& b) {
  return a.area == b.area && a.loops.size() == b.loops.size() &&
         std::equal(a.loops.begin(), a.loops.end(), b.loops.begin(),
                    [](const Loop& p, const Loop& q) { return are_equal(p, q); });
}

/// Returns the largest distance from sampled points of `boundary` to the curves of `given`.
inline double largest_deviation(const Boundary& boundary, const Boundary& given, double spacing) {
  const geometry::SegmentGrid curves(segments_of(given));
  double largest = 0;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces) {
      const int parts = std::max(1, static_cast<int>(std::ceil(piece.length() / spacing)));
      for (int k = 0; k < parts; ++k)
        largest = std::fmax(largest, curves.nearest(piece.point(piece.length() * k / parts)).squared_distance);
    }
  return std::sqrt(largest);
}

} // namespace trime::generalise
