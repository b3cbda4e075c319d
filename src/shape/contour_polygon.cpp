// SPDX-License-Identifier: BSD-3-Clause
#include "contour_polygon.hpp"

#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::shape {

namespace {

using geometry::Box;
using geometry::cross;
using geometry::Frame;
using geometry::orient2d;
using geometry::Segment;
using geometry::SegmentGrid;
using geometry::Vec2;

enum class Meeting { none, touch, crossing };

bool in_box_of(const Segment& s, Vec2 p) {
  return p.x >= std::fmin(s.a.x, s.b.x) && p.x <= std::fmax(s.a.x, s.b.x) && p.y >= std::fmin(s.a.y, s.b.y) &&
         p.y <= std::fmax(s.a.y, s.b.y);
}

/// How two segments without a common end meet; exact.
Meeting meeting_of(const Segment& s, const Segment& t) {
  if (std::fmax(s.a.x, s.b.x) < std::fmin(t.a.x, t.b.x) || std::fmax(t.a.x, t.b.x) < std::fmin(s.a.x, s.b.x) ||
      std::fmax(s.a.y, s.b.y) < std::fmin(t.a.y, t.b.y) || std::fmax(t.a.y, t.b.y) < std::fmin(s.a.y, s.b.y))
    return Meeting::none;
  const int ta = orient2d(s.a, s.b, t.a), tb = orient2d(s.a, s.b, t.b);
  if (ta * tb > 0)
    return Meeting::none;
  const int sa = orient2d(t.a, t.b, s.a), sb = orient2d(t.a, t.b, s.b);
  if (sa * sb > 0)
    return Meeting::none;
  if (ta * tb < 0 && sa * sb < 0)
    return Meeting::crossing;
  const bool touching = (ta == 0 && in_box_of(s, t.a)) || (tb == 0 && in_box_of(s, t.b)) ||
                        (sa == 0 && in_box_of(t, s.a)) || (sb == 0 && in_box_of(t, s.b));
  return touching ? Meeting::touch : Meeting::none;
}

/// A point that both segments have, to within rounding; for messages only.
Vec2 meeting_point(const Segment& s, const Segment& t) {
  const Vec2 d = s.b - s.a, e = t.b - t.a;
  const double determinant = cross(d, e);
  if (determinant == 0)
    return in_box_of(s, t.a) ? t.a : in_box_of(s, t.b) ? t.b : s.a;
  return s.a + (cross(t.a - s.a, e) / determinant) * d;
}

/// The rings on the lattice while they are made and checked.
class Placement {
public:
  Placement(const Contour& contour, const Normalization& normalization, const Frame& frame)
      : contour_(contour), normalization_(normalization), frame_(frame) {}

  Polygon make(std::vector<std::string>& warnings) {
    for (const ContourRing& ring : contour_.rings)
      add_ring(ring, warnings);
    Polygon polygon;
    polygon.grid = SegmentGrid(std::move(segments_));
    polygon.rings = std::move(rings_);
    check_meetings(polygon);
    orient(polygon);
    tell_pieces(polygon, warnings);
    return polygon;
  }

  static void orient(Polygon& polygon);

private:
  void add_ring(const ContourRing& ring, std::vector<std::string>& warnings);
  void check_turns(const std::vector<Vec2>& p, const std::vector<int>& lines) const;
  void check_meetings(const Polygon& polygon) const;
  void tell_pieces(const Polygon& polygon, std::vector<std::string>& warnings) const;
  [[noreturn]] void report(const Polygon& polygon, LocalIndex i, LocalIndex j) const;
  std::string in_file(Vec2 p) const {
    const Vec2 original = normalization_.undo(p);
    return fmt::format("({:.12g}, {:.12g})", original.x, original.y);
  }

  const Contour& contour_;
  const Normalization& normalization_;
  const Frame& frame_;
  std::vector<Segment> segments_;
  std::vector<int> segment_line_; // line of the start of each segment
  std::vector<Polygon::Ring> rings_;
};

void Placement::add_ring(const ContourRing& ring, std::vector<std::string>& warnings) {
  std::vector<Vec2> points;
  std::vector<int> lines;
  for (std::size_t k = 0; k < ring.points.size(); ++k) {
    const Vec2 p = frame_.snap(normalization_.apply(ring.points[k]));
    if (!frame_.reach().contains(p))
      throw GeometryError(fmt::format(
          "{}:{}: vertex ({}, {}) lies far outside the container [{}, {}] x [{}, {}]; enlarge [domain] or set "
          "normalize = true",
          contour_.source, ring.lines[k], ring.points[k].x, ring.points[k].y, frame_.container().min.x,
          frame_.container().max.x, frame_.container().min.y, frame_.container().max.y));
    if (!points.empty() && points.back() == p)
      continue;
    points.push_back(p);
    lines.push_back(ring.lines[k]);
  }
  while (points.size() > 1 && points.front() == points.back())
    points.pop_back();
  if (points.size() < ring.points.size())
    warnings.push_back(fmt::format("{}:{}: {} vertices of the ring that starts here are nearer than {:.3g} to the one "
                                   "before; they are merged",
                                   contour_.source, ring.lines[0], ring.points.size() - points.size(),
                                   frame_.step() / normalization_.scale));
  lines.resize(points.size());
  check_turns(points, lines);
  rings_.push_back({static_cast<LocalIndex>(segments_.size()), static_cast<LocalIndex>(points.size()), false});
  for (std::size_t k = 0; k < points.size(); ++k)
    segments_.push_back({points[k], points[(k + 1) % points.size()]});
  segment_line_.insert(segment_line_.end(), lines.begin(), lines.end());
}

void Placement::check_turns(const std::vector<Vec2>& p, const std::vector<int>& lines) const {
  const std::size_t n = p.size();
  bool collinear = true;
  for (std::size_t k = 2; k < n && collinear; ++k)
    collinear = orient2d(p[0], p[1], p[k]) == 0;
  if (collinear)
    throw GeometryError(fmt::format("{}:{}: the ring that starts here at {} encloses no area: all its vertices lie on "
                                    "one line",
                                    contour_.source, lines.empty() ? 0 : lines[0], n > 0 ? in_file(p[0]) : "nowhere"));
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 before = p[(k + n - 1) % n], here = p[k], after = p[(k + 1) % n];
    if (orient2d(before, here, after) == 0 && dot(before - here, after - here) > 0)
      throw GeometryError(fmt::format("{}:{}: the ring turns straight back at {}: the edges before and after this "
                                      "vertex overlap; remove the spike",
                                      contour_.source, lines[k], in_file(here)));
  }
}

void Placement::check_meetings(const Polygon& polygon) const {
  const std::span<const Segment> segments = polygon.grid.segments();
  const LocalIndex n = static_cast<LocalIndex>(segments.size());
  std::vector<LocalIndex> after(n), before(n);
  for (const Polygon::Ring& ring : polygon.rings)
    for (LocalIndex k = 0; k < ring.count; ++k) {
      after[ring.first + k] = ring.first + (k + 1) % ring.count;
      before[ring.first + (k + 1) % ring.count] = ring.first + k;
    }
  constexpr LocalIndex chunk = 2048;
  const LocalIndex chunks = (n + chunk - 1) / chunk;
  // Lowest pair of each chunk: what is reported does not depend on the threads.
  std::vector<std::array<LocalIndex, 2>> found(chunks, {n, n});
  thread_loop(chunks, 1, [&](std::ptrdiff_t c, int) {
    const LocalIndex first = static_cast<LocalIndex>(c) * chunk, last = std::min(n, first + chunk);
    for (LocalIndex i = first; i < last && found[c][0] == n; ++i) {
      Box box;
      box.include(segments[i].a);
      box.include(segments[i].b);
      LocalIndex partner = n;
      polygon.grid.for_each_near(box, [&](LocalIndex j) {
        if (j > i && j < partner && j != after[i] && j != before[i] &&
            meeting_of(segments[i], segments[j]) != Meeting::none)
          partner = j;
        return true;
      });
      if (partner < n)
        found[c] = {i, partner};
    }
  });
  for (const auto& pair : found)
    if (pair[0] < n)
      report(polygon, pair[0], pair[1]);
}

void Placement::report(const Polygon& polygon, LocalIndex i, LocalIndex j) const {
  const Segment &s = polygon.grid.segments()[i], &t = polygon.grid.segments()[j];
  const auto ring_of = [&](LocalIndex k) {
    std::size_t ring = 0;
    while (k >= polygon.rings[ring].first + polygon.rings[ring].count)
      ++ring;
    return ring;
  };
  const bool same = ring_of(i) == ring_of(j), crossing = meeting_of(s, t) == Meeting::crossing;
  throw GeometryError(
      fmt::format("{}:{}: the edge that starts here {} the edge that starts at line {} near {}; {}", contour_.source,
                  segment_line_[i], crossing ? "crosses" : "touches", segment_line_[j], in_file(meeting_point(s, t)),
                  same ? (crossing ? "a ring must not cross itself; is a blank line between two rings "
                                     "missing?"
                                   : "a ring touches itself; is a blank line between two rings missing?")
                       : (crossing ? "two rings must not cross" : "two rings touch or overlap")));
}

/// A warning for every ring that encloses a piece of its own, except the one of the largest area.
void Placement::tell_pieces(const Polygon& polygon, std::vector<std::string>& warnings) const {
  constexpr int most_warnings = 5;
  const std::span<const Segment> segments = polygon.grid.segments();
  std::vector<LocalIndex> starts; // first segments of the rings that are no holes
  double largest = 0;
  std::size_t main = 0;
  for (const Polygon::Ring& ring : polygon.rings) {
    const Vec2 origin = segments[ring.first].a;
    double twice_area = 0;
    for (const Segment& s : segments.subspan(ring.first, ring.count))
      twice_area += cross(s.a - origin, s.b - origin);
    if ((twice_area > 0) == ring.reversed)
      continue;
    if (std::fabs(twice_area) > largest) {
      largest = std::fabs(twice_area);
      main = starts.size();
    }
    starts.push_back(ring.first);
  }
  int told = 0;
  for (std::size_t k = 0; k < starts.size(); ++k)
    if (k != main && ++told <= most_warnings)
      warnings.push_back(
          fmt::format("{}:{}: the ring that starts here lies outside the area of all others and becomes a "
                      "separate piece",
                      contour_.source, segment_line_[starts[k]]));
  if (told > most_warnings)
    warnings.push_back(fmt::format("{}: {} more rings become separate pieces", contour_.source, told - most_warnings));
}

void Placement::orient(Polygon& polygon) {
  const std::span<const Segment> segments = polygon.grid.segments();
  for (Polygon::Ring& ring : polygon.rings) {
    LocalIndex top = 0; // highest start, rightmost of those
    for (LocalIndex k = 1; k < ring.count; ++k) {
      const Vec2 p = segments[ring.first + k].a, q = segments[ring.first + top].a;
      if (p.y > q.y || (p.y == q.y && p.x > q.x))
        top = k;
    }
    const Segment &out = segments[ring.first + top], &in = segments[ring.first + (top + ring.count - 1) % ring.count];
    const bool ccw = orient2d(in.a, out.a, out.b) > 0;
    // Just above its top a ring is outside of itself, and `inside` looks just above: what it finds is the nesting.
    const bool hole = polygon.grid.inside(out.a);
    ring.reversed = ccw == hole;
  }
}

} // namespace

Polygon make_contour_polygon(const Contour& contour, const Normalization& normalization, const Frame& frame,
                             std::vector<std::string>& warnings) {
  return Placement(contour, normalization, frame).make(warnings);
}

Polygon make_simple_polygon(const std::vector<Vec2>& ring) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < ring.size(); ++k)
    segments.push_back({ring[k], ring[(k + 1) % ring.size()]});
  Polygon polygon;
  polygon.rings.push_back({0, static_cast<LocalIndex>(segments.size()), false});
  polygon.grid = SegmentGrid(std::move(segments));
  Placement::orient(polygon);
  return polygon;
}

} // namespace trime::shape
