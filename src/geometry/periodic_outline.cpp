// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/periodic_outline.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace trime::geometry {
namespace {

std::vector<Vec2> loose_ends(const std::vector<Segment>& segments) {
  std::vector<Vec2> ends, loose;
  for (const Segment& s : segments)
    ends.insert(ends.end(), {s.a, s.b});
  std::sort(ends.begin(), ends.end(), lexicographically_less);
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
  TRIME_ASSERT(p.y < window.min.y || p.y > window.max.y, "the segments have a loose end at ({}, {}) inside the window",
               p.x, p.y);
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

namespace {

// [period] Width of the strip around the container in which the images of the border are complete.
constexpr double margin_share = 1e-3;

/// The container with a margin; without end along axes that are not periodic.
Box window_around(const Periods& periods) {
  const double far = std::numeric_limits<double>::infinity();
  const double x = margin_share * periods.x, y = margin_share * periods.y;
  const Vec2 low = periods.min, high = periods.min + Vec2{periods.x, periods.y};
  return {{periods.x > 0 ? low.x - x : -far, periods.y > 0 ? low.y - y : -far},
          {periods.x > 0 ? high.x + x : far, periods.y > 0 ? high.y + y : far}};
}

/// All images whose boxes meet the window, and so all that meet it themselves.
std::vector<Segment> images_in(const std::vector<Segment>& border, const Periods& periods, const Box& window) {
  std::vector<Segment> images;
  for (const Segment& given : border) {
    const Vec2 middle = 0.5 * (given.a + given.b), home = periods.wrap(middle) - middle;
    const auto reach = [](double way, double period) {
      return period > 0 ? 1 + static_cast<int>((0.5 * std::fabs(way) + margin_share * period) / period) : 0;
    };
    const int columns = reach(given.b.x - given.a.x, periods.x), rows = reach(given.b.y - given.a.y, periods.y);
    for (int i = -columns; i <= columns; ++i)
      for (int j = -rows; j <= rows; ++j) {
        const Vec2 shift = home + Vec2{i * periods.x, j * periods.y};
        const Segment image{given.a + shift, given.b + shift};
        if (std::fmin(image.a.x, image.b.x) <= window.max.x && std::fmax(image.a.x, image.b.x) >= window.min.x &&
            std::fmin(image.a.y, image.b.y) <= window.max.y && std::fmax(image.a.y, image.b.y) >= window.min.y)
          images.push_back(image);
      }
  }
  return images;
}

/// A point of the container on the left of a segment, with no other segment between.
Vec2 beside_first(const SegmentGrid& images, const Segment& first, const Lattice& lattice) {
  constexpr int most_halvings = 40;
  const Vec2 middle = 0.5 * (first.a + first.b), normal = left_normal(first.b - first.a);
  double share = 0.25;
  Vec2 beside = lattice.snap(middle + share * normal);
  for (int halving = 0; halving < most_halvings; ++halving, share *= 0.5) {
    beside = lattice.snap(middle + share * normal);
    const Segment& nearest = images.segments()[static_cast<std::size_t>(images.nearest(beside).segment)];
    if (nearest.a == first.a && nearest.b == first.b)
      break;
  }
  return beside;
}

} // namespace

PeriodicOutline::PeriodicOutline(const std::vector<Segment>& border, const Periods& periods, const Lattice& lattice) {
  TRIME_ASSERT(!border.empty());
  const Box window = window_around(periods);
  std::vector<Segment> images = images_in(border, periods, window);
  closed_ = SegmentGrid(close_outside(images, window, std::fmax(periods.x, periods.y)));
  images_ = SegmentGrid(std::move(images));
  const auto& longest = *std::max_element(border.begin(), border.end(), [](const Segment& s, const Segment& t) {
    return squared_length(s.b - s.a) < squared_length(t.b - t.a);
  });
  const Vec2 middle = 0.5 * (longest.a + longest.b), home = periods.wrap(middle) - middle;
  inverted_ = !closed_.inside(beside_first(images_, {longest.a + home, longest.b + home}, lattice));
}

Box PeriodicOutline::box() const {
  Box box;
  if (!inverted_)
    for (const Segment& segment : closed_.segments()) {
      box.include(segment.a);
      box.include(segment.b);
    }
  return box;
}

} // namespace trime::geometry
