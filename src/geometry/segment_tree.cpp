// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/segment_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trime::geometry {

namespace {

constexpr double rounding =
    1e-12; // share of the largest coordinate: about a thousand times the rounding error of a projection

Vec2 unit(Vec2 v) {
  const double norm = length(v);
  return norm > 0 ? Vec2{v.x / norm, v.y / norm} : Vec2{1, 0};
}

/// Least and largest of some numbers.
struct Interval {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  double width() const { return high - low; }
  double middle() const { return low + 0.5 * (high - low); }
};

} // namespace

SegmentTree::Frame::Frame(const Segment& segment) {
  const Vec2 d = segment.b - segment.a;
  center = segment.a + 0.5 * d;
  along = unit(d);
  half = {0.5 * length(d), 0};
}

SegmentTree::Frame::Frame(const Box& box) {
  half = {0.5 * box.width(), 0.5 * box.height()};
  center = box.min + half;
}

SegmentTree::SegmentTree(std::span<const Segment> segments, double margin)
    : segments_(segments), order_(segments.size()), slack_(margin) {
  std::iota(order_.begin(), order_.end(), LocalIndex{0});
  double largest = 0;
  for (const Segment& s : segments)
    for (const double v : {s.a.x, s.a.y, s.b.x, s.b.y})
      largest = std::max(largest, std::fabs(v));
  slack_ += rounding * largest;
  std::size_t leaves = 1;
  while (leaves * run_length < order_.size())
    leaves *= 2;
  nodes_.resize(2 * leaves);
  if (!order_.empty())
    build(1, {0, order_.size()});
  segments_ = {};
}

/// Mean direction of lines: doubled angles make opposite directions equal.
Vec2 SegmentTree::mean_direction(Range range) const {
  Vec2 sum;
  for (std::size_t k = range.low; k < range.high; ++k) {
    const Segment& s = segments_[at(order_[k])];
    const Vec2 d = s.b - s.a, u = unit(d);
    sum = sum + length(d) * Vec2{u.x * u.x - u.y * u.y, 2 * u.x * u.y};
  }
  const Vec2 doubled = unit(sum);
  const Vec2 mean{std::sqrt(std::fmax(0, 0.5 * (1 + doubled.x))), std::sqrt(std::fmax(0, 0.5 * (1 - doubled.x)))};
  return unit({mean.x, doubled.y < 0 ? -mean.y : mean.y});
}

void SegmentTree::build(std::size_t node, Range range) {
  const Vec2 along = mean_direction(range), across = left_normal(along);
  const auto slope = [&](LocalIndex k) { // the angle to the mean direction, as far as order is concerned
    const Vec2 d = segments_[at(k)].b - segments_[at(k)].a, u = unit(d);
    const double c = dot(u, along), s = cross(along, u);
    return c < 0 ? -s : s;
  };
  Interval u, v, slopes, middles_u, middles_v;
  double longest = 0;
  for (std::size_t k = range.low; k < range.high; ++k) {
    const Segment& s = segments_[at(order_[k])];
    for (const Vec2 p : {s.a, s.b}) {
      u.include(dot(p, along));
      v.include(dot(p, across));
    }
    const Vec2 middle = s.a + 0.5 * (s.b - s.a);
    middles_u.include(dot(middle, along));
    middles_v.include(dot(middle, across));
    slopes.include(slope(order_[k]));
    longest = std::max(longest, length(s.b - s.a));
  }
  nodes_[node] = {u.middle() * along + v.middle() * across, along, {0.5 * u.width(), 0.5 * v.width()}};
  if (range.high - range.low <= run_length)
    return;
  const double by_slope = slopes.width() * longest, by_u = middles_u.width(), by_v = middles_v.width();
  const auto key = [&](LocalIndex k) {
    if (by_slope > by_u && by_slope > by_v)
      return slope(k);
    const Segment& s = segments_[at(k)];
    return dot(s.a + 0.5 * (s.b - s.a), by_u > by_v ? along : across);
  };
  const auto place = [this](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(place(range.low), place(range.middle()), place(range.high), [&](LocalIndex a, LocalIndex b) {
    const double p = key(a), q = key(b);
    return p < q || (p == q && a < b);
  });
  build(2 * node, {range.low, range.middle()});
  build(2 * node + 1, {range.middle(), range.high});
}

/// Not if a line along a side of one of them lies between them.
bool SegmentTree::may_meet(const Turned& a, const Turned& b) const {
  const Vec2 between = b.center - a.center;
  const double c = std::fabs(dot(a.along, b.along)), s = std::fabs(cross(a.along, b.along));
  const auto apart = [&](const Turned& one, const Turned& other) {
    return std::fabs(dot(between, one.along)) > one.half.x + other.half.x * c + other.half.y * s + slack_ ||
           std::fabs(cross(between, one.along)) > one.half.y + other.half.x * s + other.half.y * c + slack_;
  };
  return !apart(a, b) && !apart(b, a);
}

} // namespace trime::geometry
